#pragma once

#include <string>
#include <vector>

#include "app/workflow/bench/collision_time.h"
#include "bench/lab/overlap/overlap_survey.h"
#include "bench/lab/whole_run.h"
#include "workflow/report/html.h"

/// The pages of the benchmarks: each one HTML file that needs nothing beside it and runs no script.
namespace vitrel {

/// Methods at a glance, charts of time against error, the stability table (share of wrong answers
/// per class and method, then all counts), a failing pair of each method, the scene of the thesis,
/// whole runs, and the overlap criteria.
std::string collision_time_page(const CollisionTimeBench& bench,
                                const std::vector<lab::OverlapRow>& overlap,
                                const std::vector<lab::WholeRun>& runs,
                                const PageProvenance& provenance);

std::string overlap_page(const std::vector<lab::OverlapRow>& rows,
                         const PageProvenance& provenance);

std::string whole_run_page(const std::vector<lab::WholeRun>& runs,
                           const PageProvenance& provenance);

}  // namespace vitrel
