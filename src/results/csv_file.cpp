#include "forming_sim/results/csv_file.h"

#include <cerrno>
#include <charconv>
#include <cmath>
#include <cstdlib>
#include <cstring>
#include <filesystem>

#include "forming_sim/config/fault.h"
#include "forming_sim/results/text_file.h"

namespace forming_sim {
namespace {

std::string row(const std::vector<std::string>& values) {
  std::string line;
  for (std::size_t i = 0; i < values.size(); ++i) line += (i ? "," : "") + values[i];
  return line + "\r\n";
}

std::string header_row(const std::vector<std::string>& columns) {
  std::vector<std::string> names;
  for (const std::string& column : columns) names.push_back(csv_text(column));
  return row(names);
}

}  // namespace

std::string csv_number(double value) {
  if (!std::isfinite(value)) return "";
  char text[32];
  const auto end = std::to_chars(text, text + sizeof text, value).ptr;
  return std::string(text, end);
}

std::string csv_text(const std::string& text) {
  if (text.find_first_of(",\"\r\n") == std::string::npos) return text;
  std::string quoted = "\"";
  for (char c : text) quoted += c == '"' ? std::string("\"\"") : std::string(1, c);
  return quoted + "\"";
}

CsvFile::CsvFile(const std::string& path, const std::vector<std::string>& columns) : path_(path) {
  replace_file(path, header_row(columns));
  open("ab");
}

std::unique_ptr<CsvFile> CsvFile::resume(const std::string& path, const std::vector<std::string>& columns, double last, double* until) {
  std::error_code unknown;
  if (!std::filesystem::exists(path, unknown)) return nullptr;
  const std::string text = read_text(path), header = header_row(columns);
  if (text.compare(0, header.size(), header) != 0) return nullptr;
  std::string kept = header;
  std::size_t begin = header.size();
  for (std::size_t end; (end = text.find("\r\n", begin)) != std::string::npos; begin = end + 2) {
    const double time = std::strtod(text.c_str() + begin, nullptr);
    if (time > last) break;
    if (until) *until = time;
    kept.append(text, begin, end + 2 - begin);
  }
  replace_file(path, kept);  // without what came later, and without half a row
  std::unique_ptr<CsvFile> file(new CsvFile(path));
  file->open("ab");
  return file;
}

void CsvFile::open(const char* mode) {
  file_.reset(std::fopen(path_.c_str(), mode));
  if (!file_) throw Error(Code::output_error, "cannot write " + path_ + ": " + std::strerror(errno));
}

void CsvFile::append(const std::vector<std::string>& values) {
  const std::string line = row(values);
  const bool good = std::fwrite(line.data(), 1, line.size(), file_.get()) == line.size();
  if (std::fflush(file_.get()) != 0 || !good)
    throw Error(Code::output_error, "cannot write " + path_ + ": " + std::strerror(errno));
}

}  // namespace forming_sim
