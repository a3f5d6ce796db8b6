#pragma once

#include <memory>
#include <string>

#include "edmd/engine.h"

/// Each file holds one explicit instantiation of Simulation, so that the event loop is compiled once per body.
namespace vitrel {

/// These texts complete the description of an engine of round particles.
inline std::string rotation_of_round(const EngineOptions& options) {
  return contacts(options) == Contacts::rough
             ? " that spin, since contacts are rough"
             : " without orientation, since every particle is round";
}
inline std::string neighbor_text(const EngineOptions& options) {
  return options.neighbors == NeighborSearch::cells
             ? "; cells without neighbour lists, since they are not dense"
             : "";
}

std::unique_ptr<Engine2> make_disk_engine(const EngineOptions& options);
std::unique_ptr<Engine2> make_ellipse_engine(const EngineOptions& options);
std::unique_ptr<Engine2> make_growing_ellipse_engine(const EngineOptions& options);
std::unique_ptr<Engine3> make_sphere_engine(const EngineOptions& options);
std::unique_ptr<Engine3> make_growing_sphere_engine(const EngineOptions& options);
std::unique_ptr<Engine3> make_ellipsoid_engine(const EngineOptions& options);
std::unique_ptr<Engine3> make_tumbling_ellipsoid_engine(const EngineOptions& options);
std::unique_ptr<Engine3> make_growing_ellipsoid_engine(const EngineOptions& options);

}  // namespace vitrel
