#include "bench/programs/report.h"

#include <fmt/format.h>

#include <nlohmann/json.hpp>

#include "app/terminal/exit_codes.h"
#include "bench/pages/page.h"
#include "core/error.h"
#include "core/io/json.h"
#include "core/io/provenance.h"
#include "core/io/text_file.h"

namespace vitrel::bench {
namespace {

/// FileError if the folder is not there and cannot be made, as something on its path is a file.
void require_output_folder(const std::filesystem::path& output) {
  std::filesystem::path there = std::filesystem::absolute(output);
  while (!std::filesystem::exists(there)) there = there.parent_path();
  if (!std::filesystem::is_directory(there))
    throw FileError(fmt::format("{}: the folder cannot be made: {} is a file", output.string(),
                                there.string()));
}

}  // namespace

Report::Report(const OutputOptions& options)
    : options_(options), session_(options.quiet, options.wall_time, StopDeadline::none) {
  if (is_wanted()) require_output_folder(options.folder);
}

void Report::print(const Json& rows, const std::string& table) {
  session_.clear();
  if (options_.json)
    print_text(json_text({{"rows", rows}}, 2) + '\n');
  else if (!options_.quiet)
    print_text(table);
}

int Report::stopped_early() const {
  if (!options_.quiet)
    fmt::print(stderr, "stopped; the table has what was done so far, and no files were written\n");
  return stopped;
}

void Report::add_provenance(Json& data, const PageProvenance& what) const {
  const Provenance now = current_provenance(options_.command_line, "", 0);
  Json& fields = data["provenance"] = {{"command", now.command_line}};
  for (const auto& [name, text] : what) fields[name] = text;
  fields["version"] = now.version;
  fields["commit"] = now.commit;
  fields["host"] = now.host;
  fields["finished"] = now.started;
  fields["wall time"] = fmt::format("{:.0f} s", session_.seconds());
}

void Report::write_data(const std::string& name, const Json& data) const {
  make_folder(options_.folder);
  write_text(options_.folder / (name + ".json"), json_text(data, 2) + "\n");
}

void Report::write_page(const std::string& name, const PageTitle& title, const Json& data) const {
  write_text(options_.folder / (name + ".html"), page(title.title, title.subtitle, data));
}

}  // namespace vitrel::bench
