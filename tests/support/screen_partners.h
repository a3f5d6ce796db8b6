#pragma once

#include "core/contact/contact_screen.h"

namespace vitrel {

/// Four partners of a contact screen, from the same box as the body itself.
template <Body B>
struct ScreenPartners {
  static constexpr int dimension = B::dimension;

  /// The pose at `time`. Its own axis starts the search.
  void set(int k, const Pose<dimension>& pose, const Motion<dimension>& motion,
           const Vec<dimension>& axis, double time = 0,
           double known_until = std::numeric_limits<double>::infinity()) {
    records[k] = flight_record<B>(pose, motion, time, known_until);
    axes[k] = {axis};
  }
  void load_into(ContactScreen<B>& screen,
                 double latest = std::numeric_limits<double>::infinity()) const {
    screen.load({&records[0], &records[1], &records[2], &records[3]},
                {&axes[0], &axes[1], &axes[2], &axes[3]}, latest);
  }

  FlightRecord<B> records[simd_width];
  WarmStart<B> axes[simd_width];
};

}  // namespace vitrel
