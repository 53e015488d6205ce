#include "core/session/ResultKind.h"

#include <algorithm>
#include <array>

namespace tacto {

namespace {

constexpr ResultTraits kOther;
constexpr std::string_view kRecording = "A recording: nothing is judged.";
constexpr std::array kKinds{
    ResultTraits{
        .kind = ResultKind::Separability,
        .name = "separability",
        .decisionRule =
            "Separable when each pair of conditions is at least 5 just-noticeable differences apart in one dimension "
            "and no coefficient of variation exceeds 5 %, each judged by its one-sided 95 % confidence bound, and the "
            "accuracy's 95 % interval begins at 95 % or above. The 5 differences and the 5 % are choices of this "
            "program."},
    ResultTraits{.kind = ResultKind::EncodingComparison,
                 .name = "encoding-comparison",
                 .decisionRule = "A comparison: the encodings are set side by side, and none is judged."},
    ResultTraits{
        .kind = ResultKind::Transitions,
        .name = "transitions",
        .decisionRule =
            "No step from one captured train to the next may exceed the just-noticeable differences wanted, "
            "uncertainty included; a change must be complete in the time wanted or, where steps of that size cannot, "
            "in the fewest trains that they take (choice); no latency may differ from its design by more than the "
            "tolerance."},
    ResultTraits{.kind = ResultKind::Variation,
                 .name = "variation",
                 .decisionRule = "A prediction: nothing is measured, and nothing is judged."},
    ResultTraits{
        .kind = ResultKind::LoadSafety,
        .name = "load-safety",
        .decisionRule =
            "Each value passes when value + U keeps its limit, fails when value − U does not, and is indeterminate "
            "between. Values that were not measured are not evaluated and prevent a pass.",
        .guardBanded = true,
        .view = ProtocolView::Loads,
        .afterPass = AfterPass::Live,
        .procedure = "safety check"},
    ResultTraits{
        .kind = ResultKind::StimulatorCalibration,
        .name = "stimulator-calibration",
        .decisionRule =
            "Each level passes when |error| + U is within the tolerance, fails when |error| − U is not, and is "
            "indeterminate between; the worse sweep direction is judged. The verdict is the worst level's.",
        .guardBanded = true,
        .view = ProtocolView::Calibration,
        .afterPass = AfterPass::SafetyCheck},
    ResultTraits{
        .kind = ResultKind::SensorCalibration,
        .name = "sensor-calibration",
        .decisionRule =
            "Accepted when the 95 % interval of d′ between the two references begins at 1 or above: the scale then "
            "tells them apart."},
    ResultTraits{.kind = ResultKind::Live, .name = "live", .decisionRule = kRecording},
    ResultTraits{.kind = ResultKind::Massager, .name = "massager", .decisionRule = kRecording},
    ResultTraits{.kind = ResultKind::PilotThresholds, .name = "pilot-thresholds", .ofStudy = true},
    ResultTraits{.kind = ResultKind::PilotIdentification, .name = "pilot-identification", .ofStudy = true}};

}  // namespace

const ResultTraits& resultTraits(std::string_view name) noexcept {
    const auto found = std::ranges::find(kKinds, name, &ResultTraits::name);
    return found == kKinds.end() ? kOther : *found;
}

}  // namespace tacto
