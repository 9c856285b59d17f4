//! Cell-ordered neighbour search, Verlet lists and the fused pair loop
