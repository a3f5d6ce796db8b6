#pragma once

#include "analysis/observables/frame_observable.h"

namespace vitrel {

/// The example of docs/tutorials/new-observable.md.
FrameObservableType<2> local_alignment_observable();

}  // namespace vitrel
