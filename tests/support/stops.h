#pragma once

#include "core/state/stage.h"

namespace vitrel {

/// Runs stage(control) again and again until it is no longer stopped, which it is whenever it has asked so many times.
/// Returns the number of stops.
template <class Stage>
int stops_of(int questions, const Stage& stage) {
  int asked = 0, stops = 0;
  const RunControl control{[&] { return ++asked % questions == 0; }, {}, {}};
  while (stage(control).end == StageEnd::stopped) ++stops;
  return stops;
}

}  // namespace vitrel
