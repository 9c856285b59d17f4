//! Soils: elastic forces, pressures between grains, water through pores, odd beds.

mod effective_pressure;
mod elastic_force;
mod elastic_operator;
mod gradients;
mod implicit_elasticity;
mod odd_beds;
mod seepage;
