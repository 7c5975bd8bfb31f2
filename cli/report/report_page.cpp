// SPDX-License-Identifier: BSD-3-Clause
#include "cli/report/report_page.hpp"

namespace sslam::cli {
namespace {

const unsigned char kPage[] = {
#include "report_page.inc"
};

const unsigned char kCompare[] = {
#include "compare_page.inc"
};

constexpr std::string_view kData = "@DATA@";

}  // namespace

ReportPage report_page() {
  const std::string_view page(reinterpret_cast<const char*>(kPage), sizeof kPage);
  constexpr std::string_view kViews = "@VIEWS@";
  const std::size_t data = page.find(kData), views = page.find(kViews);
  return {page.substr(0, data), page.substr(data + kData.size(), views - data - kData.size()),
          page.substr(views + kViews.size())};
}

ComparePage compare_page() {
  const std::string_view page(reinterpret_cast<const char*>(kCompare), sizeof kCompare);
  const std::size_t data = page.find(kData);
  return {page.substr(0, data), page.substr(data + kData.size())};
}

}  // namespace sslam::cli
