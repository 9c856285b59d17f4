//! Semi-analytical (USAW) and dummy-particle walls: wall geometry, renormalisation factor, wall state
