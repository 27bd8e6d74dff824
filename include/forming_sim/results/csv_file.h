#pragma once
// A table of numbers after RFC 4180 (comma, CRLF, a header row): every number
// with all its digits, every row in the file when append() returns.
#include <cstdio>
#include <memory>
#include <string>
#include <vector>

namespace forming_sim {

class CsvFile {
 public:
  /// A new file with its header row. Throws Error(output_error).
  CsvFile(const std::string& path, const std::vector<std::string>& columns);
  /// Goes on with a file that has these columns: rows whose first value is
  /// greater than `last` are dropped. Null where there is no such file. until: where not null, receives the first value of the last row kept.
  static std::unique_ptr<CsvFile> resume(const std::string& path, const std::vector<std::string>& columns, double last, double* until = nullptr);

  /// One value per column: text (quoted where it must be) or numbers (empty where not finite).
  void append(const std::vector<std::string>& values);

 private:
  explicit CsvFile(const std::string& path) : path_(path) {}
  void open(const char* mode);
  struct Close { void operator()(std::FILE* file) const { std::fclose(file); } };
  std::string path_;
  std::unique_ptr<std::FILE, Close> file_;
};

/// Shortest text that reads back to the same double; "" where not finite.
std::string csv_number(double value);
/// Text, in quotation marks where it holds a comma, a quotation mark or a line end.
std::string csv_text(const std::string& text);

}  // namespace forming_sim
