// SPDX-License-Identifier: BSD-3-Clause
#include "cli/batch/table_formats.hpp"

#include <cctype>
#include <cstdio>
#include <map>
#include <string_view>

namespace sslam::cli {
namespace {

constexpr const char* kCross = "\u00d7";

std::string escape(const std::string& text, const std::map<char, std::string>& replacements) {
  std::string safe;
  for (const char c : text) {
    const auto found = replacements.find(c);
    safe += found == replacements.end() ? std::string(1, c) : found->second;
  }
  return safe;
}

std::string markdown(const std::string& text) {
  return escape(
      text,
      {{'|', "\\|"}, {'*', "\\*"}, {'_', "\\_"}, {'`', "\\`"}, {'<', "&lt;"}, {'\\', "\\\\"}, {'\n', " "}});
}

std::string html(const std::string& text) {
  return escape(text, {{'&', "&amp;"}, {'<', "&lt;"}, {'>', "&gt;"}, {'"', "&quot;"}});
}

std::string latex(const std::string& text) {
  std::string safe = escape(text, {{'&', "\\&"},
                                   {'%', "\\%"},
                                   {'$', "\\$"},
                                   {'#', "\\#"},
                                   {'_', "\\_"},
                                   {'{', "\\{"},
                                   {'}', "\\}"},
                                   {'~', "\\textasciitilde{}"},
                                   {'^', "\\textasciicircum{}"},
                                   {'\\', "\\textbackslash{}"},
                                   {'\n', " "}});
  const std::string cross = kCross;
  for (auto at = safe.find(cross); at != std::string::npos; at = safe.find(cross, at))
    safe.replace(at, cross.size(), "$\\times$");
  return safe;
}

// A relative path, with what links cannot hold written by its number.
std::string url(const std::filesystem::path& path) {
  std::string text;
  for (const char c : path.generic_string()) {
    const auto byte = static_cast<unsigned char>(c);
    char code[8];
    std::snprintf(code, sizeof code, "%%%02X", byte);
    const bool plain =
        std::isalnum(byte) != 0 || std::string_view("/._-=~").find(c) != std::string_view::npos;
    text += plain ? std::string(1, c) : code;
  }
  return text;
}

// A row's name with its note.
std::string heading(const ResultTable& table, std::size_t row) {
  const std::string& note = table.row_notes[row];
  return table.row_names[row] + (note.empty() ? "" : " (" + note + ")");
}

std::string markdown_table(const ResultTable& table) {
  std::string text = markdown(table.caption) + "\n\n| Sequence |";
  std::string rule = "|---|";
  for (const std::string& column : table.columns) {
    text += " " + markdown(column) + " |";
    rule += "---|";
  }
  text += "\n" + rule + "\n";
  for (std::size_t r = 0; r < table.rows.size(); ++r) {
    text += "| " + markdown(heading(table, r)) + " |";
    for (const TableCell& cell : table.rows[r]) {
      const std::string figures = markdown(table.text(cell, kCross));
      text += cell.best ? " **" + figures + "** |" : " " + figures + " |";
    }
    text += "\n";
  }
  return text + "\n";
}

std::string latex_table(const ResultTable& table) {
  std::string text = "\\begin{table*}\n\\caption{" + latex(table.caption) +
                     "}\n\\centering\n\\begin{tabular}{l" + std::string(table.columns.size(), 'c') +
                     "}\n\\toprule\nSequence";
  for (const std::string& column : table.columns) text += " & " + latex(column);
  text += " \\\\\n\\midrule\n";
  for (std::size_t r = 0; r < table.rows.size(); ++r) {
    text += latex(heading(table, r));
    for (const TableCell& cell : table.rows[r]) {
      const std::string figures = latex(table.text(cell, kCross));
      text += " & " + (cell.best ? "\\textbf{" + figures + "}" : figures);
    }
    text += " \\\\\n";
  }
  return text + "\\bottomrule\n\\end{tabular}\n\\end{table*}\n\n";
}

std::string html_table(const ResultTable& table) {
  std::string text = "<table>\n<caption>" + html(table.caption) + "</caption>\n<thead><tr><th>Sequence</th>";
  for (const std::string& column : table.columns) text += "<th>" + html(column) + "</th>";
  text += "</tr></thead>\n<tbody>\n";
  for (std::size_t r = 0; r < table.rows.size(); ++r) {
    text += "<tr><th>" + html(heading(table, r)) + "</th>";
    for (const TableCell& cell : table.rows[r]) {
      const std::string figures = html(table.text(cell, kCross));
      const std::string kind = cell.done > 0 && cell.failed == cell.done ? " class=\"failed\"" : "";
      text += "<td" + kind + ">" + (cell.best ? "<b>" + figures + "</b>" : figures) + "</td>";
    }
    text += "</tr>\n";
  }
  return text + "</tbody>\n</table>\n";
}

constexpr const char* kHtmlStyle =
    ":root{color-scheme:light dark}body{font:15px/1.5 system-ui,sans-serif;margin:2em auto;max-width:70em;"
    "padding:0 1em}table{border-collapse:collapse;margin:1.5em 0;display:block;overflow-x:auto}"
    "caption{text-align:left;padding:.5em 0}th,td{padding:.3em .8em;border-bottom:1px solid #8886;"
    "text-align:left}.failed{color:#c43}";

}  // namespace

std::string markdown_page(const ResultPage& page) {
  std::string text = "# " + markdown(page.title) + "\n\n";
  for (const ResultTable& table : page.tables) text += markdown_table(table);
  for (const std::string& note : page.notes) text += "- " + markdown(note) + "\n";
  for (const ReportLink& report : page.reports)
    text += "- Report: [" + markdown(report.title) + "](" + url(report.path) + ")\n";
  return text;
}

std::string latex_page(const ResultPage& page) {
  std::string text =
      "% " + escape(page.title, {{'\n', " "}}) + ": tables by sslam batch; needs \\usepackage{booktabs}\n";
  for (const ResultTable& table : page.tables) text += latex_table(table);
  for (const std::string& note : page.notes) text += "% " + escape(note, {{'\n', " "}}) + "\n";
  return text;
}

std::string html_page(const ResultPage& page) {
  std::string text =
      "<!DOCTYPE html>\n<html lang=\"en\">\n<head>\n<meta charset=\"utf-8\">\n"
      "<meta name=\"viewport\" content=\"width=device-width, initial-scale=1\">\n<title>" +
      html(page.title) + "</title>\n<style>" + kHtmlStyle + "</style>\n</head>\n<body>\n<h1>" +
      html(page.title) + "</h1>\n";
  for (const ResultTable& table : page.tables) text += html_table(table);
  std::string items;
  for (const std::string& note : page.notes) items += "<li>" + html(note) + "</li>\n";
  for (const ReportLink& report : page.reports)
    items += "<li>Report: <a href=\"" + url(report.path) + "\">" + html(report.title) + "</a></li>\n";
  if (!items.empty()) text += "<ul>\n" + items + "</ul>\n";
  return text + "</body>\n</html>\n";
}

}  // namespace sslam::cli
