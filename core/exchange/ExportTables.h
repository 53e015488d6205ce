// ExportTables.h - the tables of a session and their rows: columns are described once, where the tree describes them.
// A part of ExportSource.
//
// Thread-safety: pure functions.
#pragma once

#include <functional>
#include <set>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "core/exchange/ExportSource.h"
#include "core/session/SessionReader.h"

namespace tacto {

/// Returns a name that is not taken yet, and takes it: the one wanted, else with "~2", "~3", ... if "~" stands between.
[[nodiscard]] std::string uniqueName(const std::string& wanted, std::string_view between, std::set<std::string>& taken);

/// The columns of trials.csv: of every number and text measured, in the order of their names. Units are those that
/// the tables of `kind` (core/kinds) state, else they are read from the name's end.
[[nodiscard]] ExportTable trialTable(const std::vector<SessionTrial>& trials, std::string_view kind);
void trialCells(const SessionTrial& trial, bool simulated, const ExportTable& table, std::vector<ExportCell>& cells);

[[nodiscard]] const ExportTable& trainTable();
void trainCells(const ExportTrain& train, std::vector<ExportCell>& cells);

[[nodiscard]] const ExportTable& eventTable();
[[nodiscard]] const ExportTable& recordTable();

// Puts the session's rows on trains together: the plan, the refusal and the report.

class TrainJoin {
public:
    /// `refused`: the events of that name, in order.
    TrainJoin(std::vector<const SessionRow*> refused, bool simulated);
    /// Takes the next command and hands over what is complete.
    [[nodiscard]] Result<void> take(const SessionRow& command,
                                    const std::function<Result<void>(const ExportTrain&)>& visit);
    [[nodiscard]] Result<void> end(const std::function<Result<void>(const ExportTrain&)>& visit);
    /// Whether a command is a part of a train.
    [[nodiscard]] static bool isOfTrains(std::string_view command) noexcept;

private:
    using Visit = std::function<Result<void>(const ExportTrain&)>;
    struct Plan {
        ExportTrain train;
        std::int64_t seq;
    };
    [[nodiscard]] Result<void> refuseBefore(std::int64_t seq, const Visit& visit);

    std::vector<const SessionRow*> refused_;
    std::size_t next_ = 0;
    bool simulated_;
    std::string drive_;        ///< what drives since the last such command
    std::vector<Plan> plans_;  ///< sent or about to be, and not reported yet: at most a few
};

}  // namespace tacto
