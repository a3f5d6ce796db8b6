#pragma once

#include <memory>

#include "bench/methods/method.h"
#include "edmd/engine.h"

/// @file
/// The event loop without any of its devices: no calendar, no neighbour lists, no cells, as in the
/// program of the thesis (woetzel2012, chapters 3.1 and 4.1). The baseline of the engine.
namespace vitrel::bench {

/// Which pairs are asked for their next collision after an event.
enum class Asking {
  /// All of them, as in the thesis: "due to the absence of an event calendar, the same collision is
  /// determined over and over again while unrelated events occur". No pair need look past the
  /// earliest event found before it.
  every_pair,
  /// Those of the particles whose motion has changed; a table keeps the next event of every other
  /// pair. The next event of all is found by search.
  changed_pairs,
};

struct AllPairsOptions {
  EngineOptions engine;
  Asking asking = Asking::changed_pairs;
  const Method* method = nullptr;  ///< must outlive the engine; null: the default predictor
};

/// Round pairs meet in closed form, all others by the method. A pair is asked about its nearest image
/// only, and no further than up to where another image could come within reach, |d_k| = L_k − R in a
/// direction k, R the sum of the circumradii (what the crossing of the box does in the thesis); then
/// the nearest image is chosen anew. So no collision is missed but by the method.
///
/// A pair found overlapping is treated as `engine.on_overlap` says; a correction move waits until the
/// pair has had a short time to part after its last impact, and is not made while the centres recede
/// (section 3.1.3).
///
/// `load` throws UserError if a side of the box is not longer than 2 R, or if particles are to grow.
std::unique_ptr<Engine2> make_all_pairs_engine(const AllPairsOptions& options);

}  // namespace vitrel::bench
