//! Density formulations, pressure gradients, viscous operators, smoothers and equations of state
