//! Probes, gauges, reference solutions and error norms
