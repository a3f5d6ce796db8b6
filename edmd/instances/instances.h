#pragma once

#include <memory>

#include "edmd/engine.h"

/// @file
/// One explicit instantiation of Simulation per file, so that the event loop is compiled once per
/// body.
namespace vitrel {

std::unique_ptr<Engine2> make_disk_engine(const EngineOptions& options);
std::unique_ptr<Engine2> make_ellipse_engine(const EngineOptions& options);
std::unique_ptr<Engine2> make_growing_ellipse_engine(const EngineOptions& options);
std::unique_ptr<Engine3> make_sphere_engine(const EngineOptions& options);
std::unique_ptr<Engine3> make_growing_sphere_engine(const EngineOptions& options);
std::unique_ptr<Engine3> make_ellipsoid_engine(const EngineOptions& options);
std::unique_ptr<Engine3> make_growing_ellipsoid_engine(const EngineOptions& options);

}  // namespace vitrel
