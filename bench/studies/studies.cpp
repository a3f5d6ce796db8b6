#include "bench/studies/study.h"

namespace vitrel::bench {

const std::vector<Study>& studies() {
  static const std::vector<Study> all = {
      overlap_study(),      contact_time_study(), peers_study(), whole_run_study(),
      engine_study(),       sampling_study(),     dense_study(), brownian_step_study(),
      soft_contact_study(), analysis_study(),     thesis_study()};
  return all;
}

}  // namespace vitrel::bench
