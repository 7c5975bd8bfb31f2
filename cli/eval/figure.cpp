// SPDX-License-Identifier: BSD-3-Clause
#include "cli/eval/figure.hpp"

#include <algorithm>
#include <cmath>
#include <opencv2/imgcodecs.hpp>
#include <opencv2/imgproc.hpp>
#include <string_view>

#include "cli/shell/pdf_page.hpp"
#include "sslam/io/files/output_file.hpp"
#include "sslam/io/plots/plot_view.hpp"

namespace sslam::cli {
namespace {

std::string ascii(std::string_view text) {
  std::string result;
  for (const char c : text) {
    const auto byte = static_cast<unsigned char>(c);
    if (byte >= 0x20 && byte < 0x7f) result += c;
    if (byte >= 0xc0) result += '?';  // the first byte of a character
  }
  return result;
}

std::string svg_of(const Figure& figure) {
  const auto rgb = [](const FigureColour& c) { return io::svg::format("#%02x%02x%02x", c[0], c[1], c[2]); };
  std::string svg = io::svg::format(
      "<svg xmlns=\"http://www.w3.org/2000/svg\" viewBox=\"0 0 %.0f %.0f\" "
      "font-family=\"Helvetica,Arial,sans-serif\">\n<rect width=\"100%%\" height=\"100%%\" "
      "fill=\"#fff\"/>\n",
      figure.width, figure.height);
  for (const FigureLine& line : figure.lines) {
    svg += io::svg::format("<polyline fill=\"none\" stroke=\"%s\" stroke-width=\"%.4g\" points=\"",
                           rgb(line.colour).c_str(), line.width);
    for (const Vec2<double>& p : line.points) svg += io::svg::format("%.1f,%.1f ", p.x(), p.y());
    svg.back() = '"';
    svg += "/>\n";
  }
  constexpr const char* kAnchors[] = {"start", "middle", "end"};
  for (const FigureText& text : figure.texts)
    svg += io::svg::format("<text x=\"%.1f\" y=\"%.1f\" font-size=\"%.4g\" fill=\"%s\" text-anchor=\"%s\">",
                           text.at.x(), text.at.y(), text.size, rgb(text.colour).c_str(),
                           kAnchors[static_cast<std::size_t>(text.anchor)]) +
           io::svg::escaped(text.text) + "</text>\n";
  return svg + "</svg>\n";
}

// Of Helvetica, in sizes of the font; letters are taken as equally wide.
double width_of(const std::string& text) {
  double width = 0;
  for (const char c : text) {
    if (c == '.' || c == ' ' || c == ',') {
      width += 0.278;
    } else {
      width += c == '-' ? 0.333 : 0.556;
    }
  }
  return width;
}

std::string pdf_of(const Figure& figure) {
  const auto rgb = [](const FigureColour& c, const char* operation) {
    return io::svg::format("%.3f %.3f %.3f ", c[0] / 255.0, c[1] / 255.0, c[2] / 255.0) + operation + "\n";
  };
  std::string drawing = "1 j 1 J\n";
  for (const FigureLine& line : figure.lines) {
    drawing += rgb(line.colour, "RG") + io::svg::format("%.4g w\n", line.width);
    for (std::size_t i = 0; i < line.points.size(); ++i)
      drawing += io::svg::format("%.2f %.2f %c\n", line.points[i].x(), figure.height - line.points[i].y(),
                                 i == 0 ? 'm' : 'l');
    drawing += "S\n";
  }
  for (const FigureText& text : figure.texts) {
    const std::string words = ascii(text.text);
    const double back = 0.5 * static_cast<double>(text.anchor) * text.size * width_of(words);
    drawing += rgb(text.colour, "rg") + io::svg::format("BT /F %.4g Tf %.2f %.2f Td (", text.size,
                                                        text.at.x() - back, figure.height - text.at.y());
    for (const char c : words) {
      if (c == '(' || c == ')' || c == '\\') drawing += '\\';
      drawing += c;
    }
    drawing += ") Tj ET\n";
  }
  return pdf_page(figure.width, figure.height, drawing);
}

std::string png_of(const Figure& figure) {
  constexpr double kPixels = 2;       // a unit
  constexpr int kShift = 4;           // bits of a pixel's fraction
  constexpr double kFontHeight = 30;  // of cv::FONT_HERSHEY_SIMPLEX with scale 1, about
  const auto rgb = [](const FigureColour& c) { return cv::Scalar(c[2], c[1], c[0]); };
  cv::Mat image(static_cast<int>(std::lround(kPixels * figure.height)),
                static_cast<int>(std::lround(kPixels * figure.width)), CV_8UC3, cv::Scalar::all(255));
  for (const FigureLine& line : figure.lines) {
    std::vector<cv::Point> points;
    for (const Vec2<double>& p : line.points)
      points.emplace_back(static_cast<int>(std::lround(p.x() * kPixels * (1 << kShift))),
                          static_cast<int>(std::lround(p.y() * kPixels * (1 << kShift))));
    cv::polylines(image, points, false, rgb(line.colour),
                  std::max(1, static_cast<int>(std::lround(kPixels * line.width))), cv::LINE_AA, kShift);
  }
  for (const FigureText& text : figure.texts) {
    const std::string words = ascii(text.text);
    const double scale = kPixels * text.size / kFontHeight;
    int below = 0;
    const int width = cv::getTextSize(words, cv::FONT_HERSHEY_SIMPLEX, scale, 1, &below).width;
    const double back = 0.5 * static_cast<double>(text.anchor) * width;
    cv::putText(image, words,
                {static_cast<int>(std::lround(kPixels * text.at.x() - back)),
                 static_cast<int>(std::lround(kPixels * text.at.y()))},
                cv::FONT_HERSHEY_SIMPLEX, scale, rgb(text.colour), 1, cv::LINE_AA);
  }
  std::vector<unsigned char> bytes;
  cv::imencode(".png", image, bytes);
  return {bytes.begin(), bytes.end()};
}

std::string ending_of(const std::filesystem::path& path) {
  std::string ending = path.extension().string();
  std::transform(ending.begin(), ending.end(), ending.begin(),
                 [](unsigned char c) { return static_cast<char>(std::tolower(c)); });
  return ending;
}

}  // namespace

bool is_figure_name(const std::filesystem::path& path) {
  const std::string ending = ending_of(path);
  return ending == ".svg" || ending == ".pdf" || ending == ".png";
}

void write_figure(const std::filesystem::path& path, const Figure& figure) {
  const std::string ending = ending_of(path);
  io::write_text(path, ending == ".pdf"   ? pdf_of(figure)
                       : ending == ".png" ? png_of(figure)
                                          : svg_of(figure));
}

}  // namespace sslam::cli
