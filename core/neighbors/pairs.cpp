#include "core/neighbors/pairs.h"

namespace vitrel {

template <int Dim>
CellGrid<Dim> make_cells(const Configuration<Dim>& configuration) {
  CellGrid<Dim> cells(configuration.box, 2 * largest_circumradius(configuration),
                      configuration.size());
  for (std::size_t i = 0; i < configuration.size(); ++i) cells.insert(i, configuration.position[i]);
  return cells;
}

template CellGrid<2> make_cells(const Configuration2&);
template CellGrid<3> make_cells(const Configuration3&);

}  // namespace vitrel
