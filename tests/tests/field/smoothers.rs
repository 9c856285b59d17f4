//! Smoothers under other accelerations than gravity, and energy that rises.

use crate::Field;
