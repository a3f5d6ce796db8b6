#pragma once

#include <filesystem>
#include <memory>
#include <string_view>

#include "workflow/export/frame_sink.h"

/// @file
/// Trajectories as text. Every number has as many digits, at most 17, as are needed to read back the same double.
///
/// `csv` is one table: a line per frame and particle, after one line of `name [unit]`.
///
///     in the plane                 in space
///     frame, step, time            the same          frame: its place in the trajectory, from 0
///     box_x, box_y                 …, box_z
///     id, species                  the same          id from 0
///     x, y                         …, z              wrapped into the box centred at the origin
///     unwrapped_x, unwrapped_y     …, unwrapped_z
///     angle                        qw, qx, qy, qz    unwrapped; the quaternion that turns the own
///                                                    axes into those of space
///     a, b                         a, b, c           semi-axes: a ≥ b, the angle points along a; in
///                                                    space along the own x, y and z axes
///     mass                         the same
///     vx, vy                       …, vz             velocity, if the trajectory has it
///     omega                        omega_x, …        angular velocity in the axes of space, if the
///                                                    trajectory has it
///
/// `xyz` is extended XYZ, frame after frame. OVITO recognises the columns by their names; ASE keeps all of them as
/// arrays.
///
///     Lattice, Origin                   the box, centred at the origin; pbc="T T T". In the plane
///                                       of height 1; pbc="T T F"
///     Time, Step
///     type                              the name of the species, spaces replaced by "_"
///     id                                from 0
///     pos, map_shift                    wrapped, in the plane z = 0;
///                                       unwrapped = pos + map_shift ∘ box
///     angle                             in the plane only: unwrapped, radians
///     orientation                       quaternion x, y, z, w; in the plane (0, 0, sin θ/2, cos θ/2)
///     aspherical_shape                  semi-axes a, b, c; in the plane c = b, so that bodies are
///                                       visible
///     mass
///     velo, omega                       velocity and angular velocity, both in the axes of space, if
///                                       the trajectory has them
///
/// `xytheta` writes a trajectory in the plane in the form that the animation program of appendix B.3 of woetzel2012
/// reads: a line per frame without a header line,
///
///     t x₁ y₁ θ₁ x₂ y₂ θ₂ …
///
/// - x and y are wrapped into the box centred at the origin, because that program draws the square from −R/2 to R/2
///   and nothing outside. A particle that leaves the box between two frames therefore jumps to the opposite side.
/// - θ is the angle from the x axis to the major axis in radians. It is unwrapped, because the program interpolates
///   it between frames.
///
/// The text contains neither the box nor the shapes. The program computes them from NU, AR and PF, for equal
/// particles with a b = 1 in a square box.
namespace vitrel {

/// `format` is "csv", "xyz" or "xytheta".
template <int Dim>
std::unique_ptr<FrameSink<Dim>> text_sink(std::string_view format,
                                          const std::filesystem::path& path, StoredMotion motion);

}  // namespace vitrel
