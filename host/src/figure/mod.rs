//! Figures: line charts and sheets of labelled images.
