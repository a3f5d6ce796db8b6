#pragma once

#include "core/contact/contact_screen.h"

namespace vitrel {

/// The partners of a contact screen, from the same box as the body itself.
template <Body B>
struct ScreenPartners {
  static constexpr int dimension = B::dimension, lanes = ContactScreen<B>::lanes;

  /// The pose at `time`. Its own axis starts the search.
  void set(int k, const Pose<dimension>& pose, const Motion<dimension>& motion,
           const Vec<dimension>& axis, double time = 0,
           double known_until = std::numeric_limits<double>::infinity()) {
    records[k] = flight_record<B>(pose, motion, time, known_until);
    axes[k] = {axis};
  }
  void load_into(ContactScreen<B>& screen,
                 double latest = std::numeric_limits<double>::infinity()) const {
    const FlightRecord<B>* partner[lanes];
    const WarmStart<B>* warm_start[lanes];
    for (int k = 0; k < lanes; ++k) {
      partner[k] = &records[k];
      warm_start[k] = &axes[k];
    }
    screen.load(partner, warm_start, latest);
  }

  FlightRecord<B> records[lanes];
  WarmStart<B> axes[lanes];
};

}  // namespace vitrel
