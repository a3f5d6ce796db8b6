#include "analysis/results.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <cctype>
#include <cmath>
#include <numeric>

#include "core/error.h"
#include "core/io/atomic_file.h"
#include "core/io/h5.h"
#include "core/io/text_file.h"

namespace vitrel {

namespace {

constexpr const char* error_suffix = "_error";

std::string csv_header(const Table& table) {
  std::string line;
  for (const Column& column : table.columns) {
    if (!line.empty()) line += ',';
    line += column.name;
    if (!column.error.empty()) line.append(",").append(column.name).append(error_suffix);
  }
  return line;
}

/// Formats a number; an unknown one has no sign.
std::string number(double value) {
  return std::isnan(value) ? "nan" : fmt::format("{:.17g}", value);
}

/// Returns a text for CSV, in quotes if need be.
std::string csv_text(const std::string& text) {
  if (text.find_first_of(",\"\n") == std::string::npos) return text;
  std::string quoted = "\"";
  for (const char c : text) quoted.append(c == '"' ? 2 : 1, c);
  return quoted + '"';
}

std::string csv_cell(const Column& column, std::size_t row) {
  const std::optional<std::string> text = label_of(column, row);
  return text ? csv_text(*text) : number(column.value.at(row));
}

std::string csv_row(const Table& table, std::size_t row) {
  std::string line;
  for (const Column& column : table.columns) {
    if (!line.empty()) line += ',';
    line += csv_cell(column, row);
    if (!column.error.empty()) line.append(",").append(number(column.error.at(row)));
  }
  return line;
}

std::string joined(const std::vector<std::string>& names) {
  return fmt::format("{}", fmt::join(names, ","));
}

std::vector<std::string> split(const std::string& names, char separator = ',') {
  std::vector<std::string> parts;
  for (std::size_t begin = 0; begin < names.size();) {
    const std::size_t end = std::min(names.find(separator, begin), names.size());
    parts.push_back(names.substr(begin, end - begin));
    begin = end + 1;
  }
  return parts;
}

void write_numbers(h5::Group& group, const std::string& name, const std::string& unit,
                   const std::vector<double>& values) {
  group.create_array<double>(name, {values.size()}, values).set_attribute("unit", unit);
}

// HDF5 lists members alphabetically, so a text attribute keeps their own order, as names joined by commas.
void write_table(h5::Group& root, const Table& table) {
  h5::Group group = root.create_group(table.name);
  std::vector<std::string> names;
  for (const Column& column : table.columns) {
    names.push_back(column.name);
    write_numbers(group, column.name, column.unit, column.value);
    if (!column.labels.empty())
      group.dataset(column.name)
          .set_attribute("labels", fmt::format("{}", fmt::join(column.labels, "\n")));
    if (!column.error.empty())
      write_numbers(group, column.name + error_suffix, column.unit, column.error);
  }
  group.set_attribute("description", table.description);
  group.set_attribute("columns", joined(names));
}

std::vector<std::string> table_names(const h5::Group& root, const std::filesystem::path& path) {
  if (!root.has_attribute("tables"))
    throw FileError(fmt::format(
        "{}: holds no results; a file written by `vitrel analyze` is needed", path.string()));
  return split(root.text_attribute("tables"));
}

void require_equal_lengths(const Table& table, const std::filesystem::path& path) {
  for (const Column& column : table.columns)
    if (column.value.size() != table.rows() ||
        (!column.error.empty() && column.error.size() != table.rows()))
      throw FileError(fmt::format("{}: column {} of table {} has not {} rows like the first",
                                  path.string(), column.name, table.name, table.rows()));
}

Table read_table(const h5::Group& root, const std::string& name) {
  const h5::Group group = root.group(name);
  Table table{name, group.text_attribute("description"), {}};
  for (const std::string& column : split(group.text_attribute("columns"))) {
    const h5::Dataset values = group.dataset(column);
    table.columns.push_back({column, values.text_attribute("unit"), values.read<double>()});
    if (values.has_attribute("labels"))
      table.columns.back().labels = split(values.text_attribute("labels"), '\n');
    if (group.has_dataset(column + error_suffix))
      table.columns.back().error = group.dataset(column + error_suffix).read<double>();
  }
  return table;
}

void write_provenance(h5::Group& root, const Results& results) {
  h5::Group group = root.create_group("provenance");
  std::vector<std::string> names;
  for (const auto& [name, text] : results.provenance) {
    names.push_back(name);
    group.create_text(name, text);
  }
  group.set_attribute("entries", joined(names));
}

/// Replaces names in files of earlier versions by those of today.
void rename_former(Table& table) {
  const auto rename = [](std::string& name) {
    if (name == "compressibility") name = "compressibility_factor";
  };
  rename(table.name);
  for (Column& column : table.columns) rename(column.name);
}

}  // namespace

const Column* Table::find(const std::string& column) const {
  const auto found = std::ranges::find(columns, column, &Column::name);
  return found == columns.end() ? nullptr : &*found;
}

void add_row(Table& table, const std::vector<Entry>& row) {
  for (std::size_t k = 0; k < row.size(); ++k) {
    table.columns[k].value.push_back(row[k].value);
    if (row[k].error) table.columns[k].error.push_back(*row[k].error);
  }
}

Column index_column(std::size_t count) {
  Column column{"index", "1", std::vector<double>(count)};
  std::iota(column.value.begin(), column.value.end(), 1);
  return column;
}

const Table* Results::find(const std::string& table) const {
  const auto found = std::ranges::find(tables, table, &Table::name);
  return found == tables.end() ? nullptr : &*found;
}

std::string Results::text(const std::string& name) const {
  const auto found = std::ranges::find(provenance, name, &decltype(provenance)::value_type::first);
  return found == provenance.end() ? "" : found->second;
}

std::optional<std::string> label_of(const Column& column, std::size_t row) {
  const double code = column.value.at(row);
  const bool is_known = code >= 0 && code < static_cast<double>(column.labels.size());
  return is_known ? std::optional(column.labels[static_cast<std::size_t>(code)]) : std::nullopt;
}

std::string identifier(const std::string& name) {
  std::string result = name;
  for (char& c : result)
    if (!std::isalnum(static_cast<unsigned char>(c))) c = '_';
  return result;
}

void write_csv(const std::filesystem::path& path, const Table& table) {
  std::string text = csv_header(table) + '\n';
  for (std::size_t row = 0; row < table.rows(); ++row) text += csv_row(table, row) + '\n';
  write_text(path, text);
}

void write_csv_folder(const std::filesystem::path& folder, const Results& results) {
  make_folder(folder);
  std::string columns = "table,column,unit,description\n";
  for (const Table& table : results.tables) {
    write_csv(folder / (table.name + ".csv"), table);
    for (const Column& column : table.columns)
      columns += fmt::format("{},{},{},{}\n", table.name, column.name, csv_text(column.unit),
                             csv_text(table.description));
  }
  write_text(folder / csv_columns, columns);
}

void write_results(const std::filesystem::path& path, const Results& results) {
  AtomicFile pending(path);
  h5::File file = h5::File::create(pending.partial());
  h5::Group root = file.root();
  std::vector<std::string> names;
  for (const Table& table : results.tables) {
    names.push_back(table.name);
    write_table(root, table);
  }
  root.set_attribute("tables", joined(names));
  write_provenance(root, results);
  file.close();
  pending.commit();
}

std::vector<std::string> stored_tables(const std::filesystem::path& path) {
  return table_names(h5::File::open(path, h5::Access::read).root(), path);
}

Results read_results(const std::filesystem::path& path) {
  const h5::File file = h5::File::open(path, h5::Access::read);
  const h5::Group root = file.root();
  Results results;
  for (const std::string& name : table_names(root, path)) {
    Table& table = results.tables.emplace_back(read_table(root, name));
    require_equal_lengths(table, path);
    rename_former(table);
  }
  const h5::Group provenance = root.group("provenance");
  for (const std::string& name : split(provenance.text_attribute("entries")))
    results.provenance.emplace_back(name, provenance.dataset(name).read_text());
  return results;
}

}  // namespace vitrel
