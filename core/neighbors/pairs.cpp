#include "core/neighbors/pairs.h"

namespace vitrel {

CellGrid<> make_cells(const Configuration2& configuration) {
  CellGrid<> cells(configuration.box, 2 * largest_circumradius(configuration),
                   configuration.size());
  for (std::size_t i = 0; i < configuration.size(); ++i)
    cells.insert(i, {configuration.position[i]});
  return cells;
}

}  // namespace vitrel
