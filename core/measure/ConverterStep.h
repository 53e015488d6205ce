// ConverterStep.h - the step of the converter that a record was made with, found in its samples. Private to
// core/measure.
//
// Samples of a converter lie on a grid: the values that occur are multiples of one step apart. It is seen where noise
// carries the signal to a neighbouring code and back, or where many neighbouring codes occur. Two levels and nothing
// between them (logic, a simulation) say nothing of a step, and neither do samples that lie on no grid (averages,
// filtered records).
//
// Thread-safety: pure function.
#pragma once

#include <span>

namespace tacto {

/// In the samples' unit; 0 = none is seen. Looks at some 16 000 samples. Decimal text may have rounded each to a tenth
/// of the step.
[[nodiscard]] double converterStep(std::span<const float> samples);

}  // namespace tacto
