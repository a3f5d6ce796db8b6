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
  visit(path + "wall_seconds", record.wall_seconds);
  each_item_of_trials(record.trials, path, visit);
  each_item_of_growth(record.growth, path, visit);
}

template <class Work, class Visit>
void each_item_of_work(Work& work, Visit&& visit) {
  visit("work.wall_seconds", work.wall_seconds);
  each_item_of_sampling(work.sampling, "sampling.", visit);
  each_item_of_moves(work.swelling.moves, "swelling.", visit);
  visit("swelling.growth", work.swelling.growth);
  visit("swelling.watched_sweeps", work.swelling.checked_sweeps);
  visit("swelling.watched_packing_fraction", work.swelling.checked_packing_fraction);
  each_item_of_moves(work.compression.moves, "compression.", visit);
  each_item_of_step(work.compression.box.step, "compression.box.", visit);
  visit("compression.box.aspect_at_start", work.compression.box.aspect_at_start);
  visit("compression.box.all_tried", work.compression.box.tried);
  visit("compression.box.all_accepted", work.compression.box.accepted);
  visit("compression.packing_fraction", work.compression.packing_fraction);
  each_item_of_growth(work.growth, "growth.", visit);
  each_item_of_growth(work.hybrid.growth, "hybrid.growth.", visit);
  each_item_of_sampling(work.hybrid.sampling, "hybrid.", visit);
  visit("hybrid.stretches", work.hybrid.stretches);
  visit("hybrid.stretch_end", work.hybrid.stretch_end);
}

template <class Stored, class Visit>
void each_item(Stored& stored, Visit&& visit) {
  visit("next_sweep", stored.done.next_sweep);
  visit("wall_seconds", stored.done.wall_seconds);
  for (std::size_t k = 0; k < stored.done.stages.size(); ++k)
    each_item_of_record(stored.done.stages[k], fmt::format("stage.{}.", k), visit);
  each_item_of_work(stored.work, visit);
}

}  // namespace

template <int Dim>
Checkpoint to_checkpoint(const StoredPreparation<Dim>& preparation) {
  Checkpoint checkpoint;
  checkpoint.configuration = preparation.done.configuration;
  checkpoint.parameters = preparation.parameters;
  checkpoint.counters["stages"] = preparation.done.stages.size();
  each_item(preparation, ItemWriter(checkpoint));
  return checkpoint;
}

template <int Dim>
StoredPreparation<Dim> preparation_from_checkpoint(const Checkpoint& checkpoint,
                                                   const std::filesystem::path& file) {
  const ItemReader read(checkpoint, file);
  StoredPreparation<Dim> preparation;
  preparation.done.configuration = std::get<Configuration<Dim>>(checkpoint.configuration);
  preparation.parameters = checkpoint.parameters;
  std::uint64_t stages = 0;
  read("stages", stages);
  preparation.done.stages.resize(stages);
  each_item(preparation, read);
  return preparation;
}

template Checkpoint to_checkpoint(const StoredPreparation<2>&);
template Checkpoint to_checkpoint(const StoredPreparation<3>&);
template StoredPreparation<2> preparation_from_checkpoint(const Checkpoint&,
                                                          const std::filesystem::path&);
template StoredPreparation<3> preparation_from_checkpoint(const Checkpoint&,
                                                          const std::filesystem::path&);

}  // namespace vitrel
