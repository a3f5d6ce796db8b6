#pragma once

#include <filesystem>
#include <optional>
#include <string>
#include <utility>
#include <vector>

/// @file
/// Tables of results, and the two forms in which they are written.
namespace vitrel {

/// One quantity, one value per row of its table.
struct Column {
  std::string name;  ///< letters, digits and underscores
  std::string unit;  ///< "1" for pure numbers
  std::vector<double> value = {};
  /// Standard errors, NaN where unknown; empty if the column has none.
  std::vector<double> error = {};
  /// What the values 0, 1, 2 … stand for, if they are codes; otherwise empty.
  std::vector<std::string> labels = {};
};

struct Table {
  std::string name;         ///< letters, digits and underscores
  std::string description;  ///< one sentence: what the rows are, and every convention
  std::vector<Column> columns;

  std::size_t rows() const { return columns.empty() ? 0 : columns.front().value.size(); }
  /// Returns the column of that name, or null if there is none.
  const Column* find(const std::string& column) const;
};

/// A value, and its error if the column has errors.
struct Entry {
  Entry(double number) : value(number) {}
  Entry(double number, double its_error) : value(number), error(its_error) {}

  double value;
  std::optional<double> error;
};
/// Adds an entry to every column.
void add_row(Table& table, const std::vector<Entry>& row);

/// Returns the column "index" of the numbers 1, 2 … `count`.
Column index_column(std::size_t count);

struct Results {
  std::vector<Table> tables;
  /// Where the tables come from: name (letters, digits and underscores) and text, in this order.
  std::vector<std::pair<std::string, std::string>> provenance;

  /// Returns the table of that name, or null if there is none.
  const Table* find(const std::string& table) const;
  /// Returns the text of that name from the provenance, which is empty if there is none.
  std::string text(const std::string& name) const;
};

/// Returns what the code in this row stands for, or nothing if it is unknown or the column has no codes.
std::optional<std::string> label_of(const Column& column, std::size_t row);

/// Returns the name of a species or the like in the form of names of tables and columns: characters other than letters
/// and digits become underscores.
std::string identifier(const std::string& name);

/// Writes a table as CSV: one header line of names, then one line per row with 17 significant digits (`nan` for an
/// unknown number, a label instead of a code). The column after one with errors is `name_error`. The text is written to
/// a temporary file beside `path`, which is then renamed, so that readers never see half a table. Throws FileError.
void write_csv(const std::filesystem::path& path, const Table& table);

/// Writes all tables as `<table>.csv` into a folder, which is made if it is not there, and beside them `columns.csv`
/// with a line for every column: table, column, unit and description. Throws FileError.
void write_csv_folder(const std::filesystem::path& folder, const Results& results);
/// The name of the file of units.
inline constexpr const char* csv_columns = "columns.csv";

/// Writes HDF5: a group for each table, with the attribute `description`. In it each column is an f64 dataset, with the
/// attribute `unit` and, if it holds codes, `labels`, one a line; its errors are in `<name>_error` beside it. The texts
/// of the provenance are in the group `provenance`. The attributes `tables`, `columns` and `entries` keep the order.
/// The file is replaced atomically as in write_csv. Throws FileError.
void write_results(const std::filesystem::path& path, const Results& results);

/// Returns the names of the tables in a file of write_results. Throws FileError.
std::vector<std::string> stored_tables(const std::filesystem::path& path);

/// Reads a file of write_results; the former name `compressibility` of tables and columns becomes
/// `compressibility_factor`. Throws FileError.
Results read_results(const std::filesystem::path& path);

}  // namespace vitrel
