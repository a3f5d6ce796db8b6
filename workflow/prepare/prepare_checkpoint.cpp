#include "workflow/prepare/prepare_checkpoint.h"

#include <fmt/format.h>

#include "workflow/storage/checkpoint_items.h"
#include "workflow/storage/state_items.h"

namespace vitrel {
namespace {

template <class Record, class Visit>
void each_item_of_record(Record& record, const std::string& path, Visit&& visit) {
  visit(path + "reason", record.report.reason);
  visit(path + "packing_fraction", record.packing_fraction);
  visit(path + "mean_packing_fraction", record.mean_packing_fraction.mean);
  visit(path + "mean_packing_fraction_error", record.mean_packing_fraction.error);
  visit(path + "sweeps", record.sweeps);
  visit(path + "chain_contacts", record.chain_contacts);
  visit.if_recorded(path + "chain_pressure", record.chain_pressure);
  visit.if_recorded(path + "decorrelations", record.decorrelations);
  visit(path + "wall_seconds", record.wall_seconds);
  visit.if_recorded(path + "orientation_tensor", record.orientation_tensor);
  each_item_of_trials(record.trials, path, visit);
  each_item_of_growth(record.growth, path, visit);
}

template <class Stored, class Visit>
void each_item(Stored& stored, Visit&& visit) {
  visit("next_sweep", stored.done.next_sweep);
  visit("wall_seconds", stored.done.wall_seconds);
  for (std::size_t k = 0; k < stored.done.stages.size(); ++k)
    each_item_of_record(stored.done.stages[k], fmt::format("stage.{}.", k), visit);
  visit("work.wall_seconds", stored.stage_seconds);
  each_item_of_stage(stored.state, visit);
}

}  // namespace

template <int Dim>
Checkpoint to_checkpoint(const PrepareCheckpoint<Dim>& preparation) {
  Checkpoint checkpoint;
  checkpoint.configuration = preparation.done.configuration;
  checkpoint.parameters = preparation.parameters;
  checkpoint.counters["stages"] = preparation.done.stages.size();
  each_item(preparation, ItemWriter(checkpoint));
  return checkpoint;
}

template <int Dim>
PrepareCheckpoint<Dim> preparation_from_checkpoint(const Checkpoint& checkpoint,
                                                   const std::vector<Stage>& stages,
                                                   const std::filesystem::path& file) {
  const ItemReader read(checkpoint, file);
  PrepareCheckpoint<Dim> preparation;
  preparation.done.configuration = std::get<Configuration<Dim>>(checkpoint.configuration);
  preparation.parameters = checkpoint.parameters;
  std::uint64_t ended = 0;
  read("stages", ended);
  preparation.done.stages.resize(ended);
  // The number of the next sweep is among the items.
  if (ended < stages.size()) preparation.state = first_state(stages[ended], 0);
  each_item(preparation, read);
  return preparation;
}

template Checkpoint to_checkpoint(const PrepareCheckpoint<2>&);
template Checkpoint to_checkpoint(const PrepareCheckpoint<3>&);
template PrepareCheckpoint<2> preparation_from_checkpoint(const Checkpoint&,
                                                          const std::vector<Stage>&,
                                                          const std::filesystem::path&);
template PrepareCheckpoint<3> preparation_from_checkpoint(const Checkpoint&,
                                                          const std::vector<Stage>&,
                                                          const std::filesystem::path&);

}  // namespace vitrel
