#pragma once

#include <memory>

#include "edmd/engine.h"

/// One explicit instantiation of Simulation per file, so that the event loop is compiled once per
/// body.
namespace vitrel {

std::unique_ptr<Engine> make_disk_engine(const EngineOptions& options);
std::unique_ptr<Engine> make_ellipse_engine(const EngineOptions& options);
std::unique_ptr<Engine> make_growing_engine(const EngineOptions& options);

}  // namespace vitrel
