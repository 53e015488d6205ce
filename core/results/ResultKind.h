// ResultKind.h - what is declared of a kind of results, beside the analysis that gives it. core/kinds lists them all.
#pragma once

#include <string_view>
#include <vector>

#include "core/results/ResultTable.h"

namespace tacto {

/// Kinds for which the program does something by itself.
enum class ResultKind {
    Other,  ///< a laboratory's own, one that is a table and a verdict and no more, or none
    Separability,
    EncodingComparison,
    Transitions,
    Variation,
    LoadSafety,
    StimulatorCalibration,
    SensorCalibration,
    Live,
    Massager,
    PilotThresholds,
    PilotIdentification
};

struct ResultTraits {
    ResultKind kind = ResultKind::Other;
    std::string_view name = {};          ///< "separability"; empty where results have no declared kind
    std::string_view decisionRule = {};  ///< where the results state none; empty: as the script says in its reasons
    bool guardBanded = false;            ///< judged with the uncertainty counting against the device
    bool ofStudy = false;                ///< a session of a study: with a participant, on their record
    std::string_view procedure = {};     ///< what people call it, where that is not its name: "safety check"
    std::vector<ResultTable> tables{};   ///< in the order in which they are read
};

}  // namespace tacto
