#pragma once

namespace elastolab {

/// What an iterative solver has done so far.
struct IterationReport {
    int iterations = 0;
    double residual = 0.0;  ///< relative, the largest of all columns
};

/// Throws the SolveError of an iteration that ends at this residual without an answer. name: of its matrix.
[[noreturn]] void give_up_iteration(const char* name, double residual);

}  // namespace elastolab
