// Carries the precompiled header of Eigen that every room shares.
