#include "analysis/dynamics/tracks.h"

namespace vitrel {

std::vector<Track> read_tracks(Trajectory& trajectory, std::size_t begin, std::size_t end,
                               const std::function<void(double)>& tell) {
  const std::size_t frames = trajectory.frames();
  std::vector<Track> tracks(end - begin);
  for (Track& track : tracks) {
    track.x.resize(frames);
    track.y.resize(frames);
    track.angle.resize(frames);
  }
  for (std::size_t k = 0; k < frames; ++k) {
    const Configuration2& frame = trajectory.read(k);
    for (std::size_t i = begin; i < end; ++i) {
      const Vec2 position = frame.unwrapped(i);
      Track& track = tracks[i - begin];
      track.x[k] = position.x();
      track.y[k] = position.y();
      track.angle[k] = frame.angle[i];
    }
    tell(static_cast<double>(k + 1) / static_cast<double>(frames));
  }
  return tracks;
}

}  // namespace vitrel
