#include "core/analysis/identification/IdentificationTrial.h"

namespace tacto {

Result<TrialPhase> trialPhaseFrom(std::string_view name) {
    if (const auto known = valueFor(kTrialPhases, name)) return *known;
    return fail(ErrorCode::InvalidArgument, "the phase is \"{}\"; familiarisation, training or test is accepted", name);
}

LabelFeatures featuresOf(std::string_view label) noexcept {
    const auto hyphen = label.find('-');
    if (hyphen == std::string_view::npos) return {label, {}};
    return {label.substr(0, hyphen), label.substr(hyphen + 1)};
}

}  // namespace tacto
