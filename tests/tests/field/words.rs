//! Warnings, estimates and advice.
