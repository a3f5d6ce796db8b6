#pragma once

#include <memory>

#include "bench/methods/method.h"
#include "edmd/engine.h"

/// @file
/// The event loop without any acceleration: it has no calendar, no neighbour lists and no cells, like the program of
/// the thesis (woetzel2012, chapters 3.1 and 4.1). It is the baseline of the engine.
namespace vitrel::bench {

/// The pairs whose next collision is predicted after an event.
enum class Asking {
  /// All pairs, as in the thesis: "due to the absence of an event calendar, the same collision is determined over and
  /// over again while unrelated events occur". The search for a pair ends at the earliest event found so far.
  every_pair,
  /// The pairs of particles whose motion has changed. A table keeps the next event of every other pair, and a search
  /// finds the earliest of all.
  changed_pairs,
};

struct AllPairsOptions {
  EngineOptions engine;
  Asking asking = Asking::changed_pairs;
  const Method* method = nullptr;  ///< must outlive the engine; the default predictor if null
};

/// Round pairs are predicted in closed form, all others by the method. Only the nearest image of a pair is
/// considered, and only until another image could come within reach, which is when |d_k| = L_k − R in some direction
/// k, with the sum R of the circumradii (crossing the box plays this part in the thesis). The nearest image is then
/// chosen anew. Thus only the method can miss a collision.
///
/// `engine.on_overlap` determines what happens to a pair that overlaps. A correction move waits until the pair has
/// had a short time to separate after its last impact, and is not made while the centres recede (section 3.1.3).
///
/// `load` throws UserError if a side of the box is not longer than 2 R, or if the particles grow.
std::unique_ptr<Engine2> make_all_pairs_engine(const AllPairsOptions& options);

}  // namespace vitrel::bench
