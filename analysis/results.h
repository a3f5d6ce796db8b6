#pragma once

#include <filesystem>
#include <optional>
#include <string>
#include <utility>
#include <vector>

/// @file
/// Tables of results, and the two forms they are written in.
namespace vitrel {

/// One quantity, one value per row of its table.
struct Column {
  std::string name;  ///< letters, digits and underscores
  std::string unit;  ///< "1" for pure numbers
  std::vector<double> value = {};
  /// Standard errors, NaN where unknown; empty: the column has none.
  std::vector<double> error = {};
  /// What the values 0, 1, 2 … stand for, if they are codes; else empty.
  std::vector<std::string> labels = {};
};

struct Table {
  std::string name;         ///< letters, digits and underscores
  std::string description;  ///< one sentence: what the rows are, and every convention
  std::vector<Column> columns;

  std::size_t rows() const { return columns.empty() ? 0 : columns.front().value.size(); }
  /// The column of that name; null if there is none.
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

/// The column "index" of the numbers 1, 2 … `count`.
Column index_column(std::size_t count);

struct Results {
  std::vector<Table> tables;
  /// Where they come from: name (letters, digits and underscores) and text, in this order.
  std::vector<std::pair<std::string, std::string>> provenance;

  /// The table of that name; null if there is none.
  const Table* find(const std::string& table) const;
  /// The text of that name from the provenance; empty if there is none.
  std::string text(const std::string& name) const;
};

/// What the code in that row stands for; nothing if it is unknown, or the column has no codes.
std::optional<std::string> label_of(const Column& column, std::size_t row);

/// The name of a species or the like as names of tables and columns may be: other characters than
/// letters and digits become underscores.
std::string identifier(const std::string& name);

/// CSV: one line per row with 17 significant digits (`nan` for an unknown number, a label instead of a
/// code), after one header line of names; the column after one with errors is `name_error`. Written to a
/// temporary file beside `path` and renamed, so that readers never see half a table. Throws
/// FileError.
void write_csv(const std::filesystem::path& path, const Table& table);

/// All tables as `<table>.csv` in a folder, which is made if it is not there, and beside them `columns.csv`: table,
/// column, unit and description, a line for every column. Throws FileError.
void write_csv_folder(const std::filesystem::path& folder, const Results& results);
/// The name of the file of units.
inline constexpr const char* csv_columns = "columns.csv";

/// HDF5: a group per table with attribute `description`; in it an f64 dataset per column, with the attributes `unit`
/// and, of codes, `labels`, one a line, and `<name>_error` beside it; the texts of the provenance in a group of that
/// name. The order is kept in the attributes `tables`, `columns` and `entries`. Atomic like write_csv. Throws
/// FileError.
void write_results(const std::filesystem::path& path, const Results& results);

/// The names of the tables in what write_results wrote. Throws FileError.
std::vector<std::string> stored_tables(const std::filesystem::path& path);

/// Reads what write_results wrote; the former name `compressibility` of tables and columns becomes
/// `compressibility_factor`. Throws FileError.
Results read_results(const std::filesystem::path& path);

}  // namespace vitrel
