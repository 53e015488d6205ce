// ExportTables.h - the tables of a session and their rows: columns are described once, where the tree describes them.
// A part of ExportSource.
//
// Thread-safety: pure functions.
#pragma once

#include <functional>
#include <initializer_list>
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

[[nodiscard]] bool isSimulated(const SessionDevice& device);
/// Whether what devices of these roles made is simulated; `otherwise` if there are none.
[[nodiscard]] bool simulatedOf(const SessionAbout& about, std::initializer_list<Role> roles, bool otherwise);

/// Returns the unique name of each column of a stream, the same in every format, and its unit.
[[nodiscard]] std::vector<ExportChannel> channelsOf(const SessionStream& stream, const std::string& kind);

/// The columns of trials.csv: of every number and text measured, in the order of their names. Units are those that
/// the tables of `kind` (core/kinds) state, else they are read from the name's end.
[[nodiscard]] ExportTable trialTable(const std::vector<SessionTrial>& trials, std::string_view kind);
void trialCells(const SessionTrial& trial, bool simulated, const ExportTable& table, std::vector<ExportCell>& cells);

[[nodiscard]] const ExportTable& trainTable();
/// The columns of numbers behind the time, for streams that hold only numbers; "1" where there is no unit.
[[nodiscard]] std::vector<ExportChannel> numberChannels(const ExportTable& table);
/// The values of these columns.
[[nodiscard]] std::vector<double> numbersIn(std::span<const ExportCell> cells);
void trainCells(const ExportTrain& train, std::vector<ExportCell>& cells);

[[nodiscard]] const ExportTable& eventTable();
[[nodiscard]] const ExportTable& recordTable();

// Puts the session's rows on trains together: the plan, the refusal and the report.

class TrainJoin {
public:
    /// `refused`: the events of that name, in order.
    TrainJoin(std::vector<const SessionRow*> refused, bool simulated);
    /// Takes an event "refused" that the constructor was not given, in its turn among the commands.
    [[nodiscard]] Result<void> refuse(const SessionRow& event,
                                      const std::function<Result<void>(const ExportTrain&)>& visit);
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
