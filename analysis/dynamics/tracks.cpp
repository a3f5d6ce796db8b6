#include "analysis/dynamics/tracks.h"

namespace vitrel {

namespace {

void set_orientation(Track<2>& track, std::size_t k, const Configuration2& frame, std::size_t i) {
  track.orientation[0][k] = frame.angle[i];
}

void set_orientation(Track<3>& track, std::size_t k, const Configuration3& frame, std::size_t i) {
  const Quaternion& q = frame.orientation[i];
  track.orientation[0][k] = q.w();
  track.orientation[1][k] = q.x();
  track.orientation[2][k] = q.y();
  track.orientation[3][k] = q.z();
}

}  // namespace

template <int Dim>
std::vector<Track<Dim>> read_tracks(Trajectory<Dim>& trajectory, std::size_t begin, std::size_t end,
                                    const std::function<void(double)>& tell) {
  const std::size_t frames = trajectory.frames();
  std::vector<Track<Dim>> tracks(end - begin);
  for (Track<Dim>& track : tracks) {
    for (FrameSeries& series : track.position) series.resize(frames);
    for (FrameSeries& series : track.orientation) series.resize(frames);
    track.turn_period = trajectory.turn_period();
  }
  for (std::size_t k = 0; k < frames; ++k) {
    const Configuration<Dim>& frame = trajectory.read_places(k);
    for (std::size_t i = begin; i < end; ++i) {
      const Vec<Dim> position = frame.unwrapped(i);
      Track<Dim>& track = tracks[i - begin];
      for (std::size_t d = 0; d < Dim; ++d) track.position[d][k] = position[static_cast<int>(d)];
      set_orientation(track, k, frame, i);
    }
    tell(static_cast<double>(k + 1) / static_cast<double>(frames));
  }
  return tracks;
}

template std::vector<Track<2>> read_tracks(Trajectory2&, std::size_t, std::size_t,
                                           const std::function<void(double)>&);
template std::vector<Track<3>> read_tracks(Trajectory3&, std::size_t, std::size_t,
                                           const std::function<void(double)>&);

}  // namespace vitrel
