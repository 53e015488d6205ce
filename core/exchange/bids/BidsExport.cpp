#include "core/exchange/bids/BidsExport.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <map>
#include <set>

#include "core/base/JsonText.h"
#include "core/exchange/ExportTables.h"
#include "core/exchange/bids/BidsFolder.h"
#include "core/exchange/bids/NibsFiles.h"
#include "core/exchange/bids/PhysioFiles.h"
#include "core/exchange/bids/TsvOut.h"
#include "core/sharing/BidsFiles.h"

namespace tacto {

namespace {

namespace fs = std::filesystem;
using nlohmann::json;
using Cells = std::vector<ExportCell>;

class BidsWriter {
public:
    BidsWriter(const ExportSource& source, const fs::path& root) : source_(source), folder_(source, root) {}

    Result<void> write(ExportReport& report) {
        for (const auto step : {&BidsWriter::writeDataset, &BidsWriter::writeTrials, &BidsWriter::writeTrains,
                                &BidsWriter::writeEvents}) {
            if (auto written = (this->*step)(); !written) return written;
        }
        if (hasNibsFiles(source_)) {
            if (auto written = writeNibsFiles(source_, folder_); !written) return written;
        }
        return writePhysioFiles(source_, folder_, report);
    }

private:
    /// A table that is written row by row, and its sidecar.
    struct Table {
        std::string suffix;  ///< "events"
        std::vector<BidsColumn> columns;
        bool simulated;
    };

    Result<void> writeTable(const Table& table, const std::function<Result<void>(TsvOut&)>& rows) const {
        const auto path = folder_.path("beh", table.suffix + ".tsv");
        if (!path) return failure(path);
        TsvOut out(*path);
        for (const auto& column : table.columns) out.text(column.name);
        if (auto ended = out.endRow(); !ended) return ended;
        if (auto written = rows(out); !written) return written;
        if (auto ended = out.end(); !ended) return ended;
        auto about = folder_.sidecar(table.simulated);
        about.update(BidsTable(table.columns).sidecar());
        const auto sidecar = folder_.path("beh", table.suffix + ".json");
        return sidecar ? folder_.writeJson(*sidecar, about) : failure(sidecar);
    }

    static Result<void> writeRow(TsvOut& out, std::span<const ExportCell> cells) {
        for (const auto& cell : cells) out.cell(cell);
        return out.endRow();
    }

    Result<void> writeDataset() const;

    Result<void> writeTrials() const {
        const auto& trials = source_.trials();
        Table table{"beh",
                    {{"trial", "Number of the trial, from 1", "1"},
                     {"trial_type", "Condition", ""},
                     {"time", "When the trial was recorded, since the session's start", "s"}},
                    source_.simulated(trials)};
        constexpr std::size_t kOwn = 3;  // time, trial and condition, which stand first
        // What these names mean in BIDS is not what a script measured.
        std::set<std::string> taken{"trial", "trial_type", "time", "onset", "duration", "response_time", "HED"};
        for (std::size_t c = kOwn; c < trials.columns.size(); ++c) {
            auto column = bidsColumn(trials.columns[c]);
            if (c + 1 < trials.columns.size()) column.description = "Measured: " + column.description;
            column.name = uniqueName(taken.contains(column.name) ? "measured_" + column.name : column.name, "_", taken);
            table.columns.push_back(std::move(column));
        }
        return writeTable(table, [&](TsvOut& out) {
            return source_.forEachRow(trials, [&](std::span<const ExportCell> cells) {
                Cells row{cells[1], cells[2], cells[0]};
                row.insert(row.end(), cells.begin() + kOwn, cells.end());
                return writeRow(out, row);
            });
        });
    }

    /// A row for each train, in the order of their onsets: reports come later than what was refused meanwhile.
    Result<void> writeTrains() const {
        constexpr std::size_t kOwn = 2;       // time and outcome
        constexpr std::size_t kWaiting = 64;  // rows
        const auto& trains = source_.trains();
        Table table{"events",
                    {{"onset", "Since the session's start", "s"},
                     {"duration", "Until the end of its last pulse", "s"},
                     {"trial_type",
                      "What it was",
                      "",
                      {{"train", "a train of pulses"},
                       {"check", "a pulse that measures the impedance"},
                       {"burst", "a vibration of a massager"}}},
                     {"event_id", "The train; _nibs.tsv describes those that were put out", ""},
                     {"outcome",
                      "What became of it",
                      "",
                      {{"delivered", "the device delivered it"},
                       {"refused", "a limit refused it before it was sent"},
                       {"voided", "a stop came before it was sent"},
                       {"failed", "the device failed"},
                       {"check", "the device delivered a check"},
                       {"burst", "the massager delivered it"}}}},
                    source_.simulated(trains)};
        for (std::size_t c = kOwn; c < trains.columns.size(); ++c)
            table.columns.push_back(bidsColumn(trains.columns[c]));
        return writeTable(table, [&](TsvOut& out) {
            std::uint64_t number = 0;
            std::multimap<double, Cells> waiting;
            const auto writeFirst = [&] {
                const auto row = std::move(waiting.extract(waiting.begin()).mapped());
                return writeRow(out, row);
            };
            Cells cells;
            auto read = source_.forEachTrain([&](const ExportTrain& train) -> Result<void> {
                using enum ExportTrain::Outcome;
                trainCells(train, cells);
                Cells row{train.time_s, outputDuration_s(train),
                          std::string(train.outcome == Check   ? "check"
                                      : train.outcome == Burst ? "burst"
                                                               : "train"),
                          bidsEventId(++number), std::string(nameOf(train.outcome))};
                row.insert(row.end(), cells.begin() + kOwn, cells.end());
                waiting.emplace(train.time_s, std::move(row));
                return waiting.size() > kWaiting ? writeFirst() : Result<void>();
            });
            while (read && !waiting.empty()) read = writeFirst();
            return read;
        });
    }

    Result<void> writeEvents() const {
        const auto& events = source_.events();
        const Table table{"acq-session_events",
                          {{"onset", "Since the session's start", "s"},
                           {"duration", "n/a: events have none", "s"},
                           {"trial_type", "Kind of the event", ""},
                           {"details", "What the session says of it, as JSON", ""},
                           {"simulated", "1: simulated, 0: not", "1"}},
                          source_.simulated(events)};
        return writeTable(table, [&](TsvOut& out) {
            std::vector<const SessionRow*> rows;
            for (const auto& event : source_.eventRows()) rows.push_back(&event);
            std::ranges::stable_sort(rows, {}, &SessionRow::at);
            const double simulated = table.simulated ? 1 : 0;
            for (const auto* event : rows) {
                const Cells row{toSeconds(event->at), kNaN, event->name, dumpJson(event->body), simulated};
                if (auto written = writeRow(out, row); !written) return written;
                if (auto on = source_.goOn(); !on) return on;
            }
            return Result<void>();
        });
    }

    const ExportSource& source_;
    const BidsFolder folder_;
};

/// What a reader must know first.
std::string readme(const ExportSource& source, const std::string& title) {
    const auto& about = source.description();
    auto text = fmt::format("{}\n\n", title);
    if (source.simulated())
        text +=
            "SIMULATED: at least one device was simulated. The column `simulated` and each sidecar say of what.\n\n";
    text += fmt::format(
        "Marks: {}.\nProtocol: {}. Recorded by Tactoscope {}, exported by {}.\nSession {}, chain head "
        "{}.\nTime 0 is {} (UTC).\n\n",
        source.marks().empty() ? "none" : source.marksText(), textOr(about, "protocol"), source.about().programVersion,
        source.version(), source.name(), source.chainHead(), source.wallStart());
    for (const auto& statement : textsOr(about, "statements")) text += statement + "\n";
    text +=
        "\n_beh.tsv: a row for each trial. _events.tsv: a row for each train. _acq-session_events.tsv: everything else "
        "that happened. recording-KIND_physio.tsv.gz: each stream on a regular grid of its own; a row without a sample "
        "is n/a. All times are seconds since the session's start.\n";
    if (hasNibsFiles(source)) {
        const auto version = nibsVersion();
        text += fmt::format(
            "nibs/: what was put out, in the form of the draft NIBS-BIDS ({}, version {}, commit {}). The validator "
            "does "
            "not know it yet, so .bidsignore names it.\n",
            textOr(version, "Proposal"), textOr(version, "Version"), textOr(version, "Commit"));
    }
    return text;
}

Result<void> BidsWriter::writeDataset() const {
    const auto title = fmt::format("{}{}", source_.name(), source_.simulated() ? " (simulated)" : "");
    auto about = bidsDescription(title, "", source_.version());
    const bool person = source_.about().mode == "person";
    about["EthicsApprovals"] = json::array({person ? "see the study" : "none: no person took part"});
    about["Simulated"] = source_.simulated();
    about["Marks"] = source_.marks();
    about["Session"] = source_.description();
    const bool nibs = hasNibsFiles(source_);
    if (nibs) about["NIBSBIDS"] = nibsVersion();
    if (auto written = folder_.writeJson("dataset_description.json", about); !written) return written;
    if (auto written = folder_.writeText("README", readme(source_, title)); !written) return written;
    if (nibs) {
        if (auto written = folder_.writeText(".bidsignore", kNibsIgnored); !written) return written;
    }
    BidsTable participants({{"participant_id", "Label of the participant", ""},
                            {"species", "Species; n/a where no person took part", ""},
                            {"basis",
                             "What the data rest on",
                             "",
                             {{"simulated", "at least one device was simulated"},
                              {"bench load", "devices on a load"},
                              {"person", "devices on a person"}}}});
    const bool simulated = source_.simulated();
    participants.add({folder_.subject(), person && !simulated ? "homo sapiens" : "",
                      simulated ? std::string("simulated") : source_.about().mode});
    if (auto written = folder_.writeText("participants.tsv", participants.tsv()); !written) return written;
    auto sidecar = participants.sidecar();
    sidecar["Simulated"] = simulated;
    sidecar["Marks"] = source_.marks();
    return folder_.writeJson("participants.json", sidecar);
}

Result<void> writeBidsDataset(const ExportSource& source, const fs::path& draft, ExportReport& report) {
    return BidsWriter(source, draft).write(report);
}

std::uint64_t bidsSize(const ExportSource& source) {
    constexpr std::uint64_t kOfNumber = 6, kOfTrain = 500;  // bytes, about; numbers are gzipped
    std::uint64_t bytes = kOfTrain * source.trainCount();
    for (const auto& stream : source.streams()) bytes += stream.samples * kOfNumber * stream.channels.size();
    return bytes;
}

}  // namespace

const ExportFormat& bidsExport() {
    static const ExportFormat format{
        .name = "bids",
        .title = "BIDS: a folder of behaviour, events, recordings and stimulation",
        .suffix = "",
        .cannot = {{ExportContent::Captures, "BIDS holds no records of microseconds"},
                   {ExportContent::Records, "BIDS has no place for commands, verdicts, report items and log lines"}},
        .write = writeBidsDataset,
        .size = bidsSize};
    return format;
}

}  // namespace tacto
