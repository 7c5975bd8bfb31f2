// SPDX-License-Identifier: BSD-3-Clause
// A PDF of one page (ISO 32000-1), with Helvetica as its only font.
#pragma once

#include <array>
#include <cstdio>
#include <string>
#include <string_view>

namespace sslam::cli {

// width and height in points of 1/72 inch; drawing: a content stream, in which the font is called F.
// preferences: of the catalogue, may be empty.
[[nodiscard]] inline std::string pdf_page(double width, double height, const std::string& drawing,
                                          const std::string& preferences = "") {
  char box[80];
  std::snprintf(box, sizeof box, "%.4f %.4f", width, height);
  const std::array<std::string, 5> objects{
      "<< /Type /Catalog /Pages 2 0 R " + preferences + ">>", "<< /Type /Pages /Kids [3 0 R] /Count 1 >>",
      "<< /Type /Page /Parent 2 0 R /MediaBox [0 0 " + std::string(box) +
          "] /Contents 4 0 R /Resources << /Font << /F 5 0 R >> >> >>",
      "<< /Length " + std::to_string(drawing.size()) + " >>\nstream\n" + drawing + "endstream",
      "<< /Type /Font /Subtype /Type1 /BaseFont /Helvetica >>"};
  const std::string count = std::to_string(objects.size() + 1);
  std::string pdf = "%PDF-1.4\n", table = "xref\n0 " + count + "\n0000000000 65535 f \n";
  for (std::size_t i = 0; i < objects.size(); ++i) {
    char entry[32];
    std::snprintf(entry, sizeof entry, "%010zu 00000 n \n", pdf.size());
    table += entry;
    pdf += std::to_string(i + 1) + " 0 obj\n" + objects[i] + "\nendobj\n";
  }
  const std::string start = std::to_string(pdf.size());
  return pdf + table + "trailer\n<< /Size " + count + " /Root 1 0 R >>\nstartxref\n" + start + "\n%%EOF\n";
}

}  // namespace sslam::cli
