#include "core/acquisition/RecordingDraft.h"

#include <algorithm>
#include <cmath>
#include <fmt/format.h>
#include <optional>

#include "core/acquisition/RecordingTable.h"
#include "core/acquisition/RecordingUnits.h"
#include "core/acquisition/SignalStreams.h"
#include "core/acquisition/StreamHealth.h"
#include "core/base/Csv.h"
#include "core/base/CsvHead.h"
#include "core/base/JsonText.h"
#include "core/base/LocaleFreeText.h"
#include "core/base/Utf16.h"

namespace tacto {

namespace {

using Json = nlohmann::json;

bool isTimeName(std::string_view name) {
    return name == "t" || name == "zeit" || name == "temps" || name.find("time") != std::string_view::npos ||
           name.find("stamp") != std::string_view::npos || name == "seconds" || name == "second";
}

/// A column, as described by its header.
struct DraftColumn {
    Json called;  ///< name of the channel, or its number from 1
    std::string name;
    std::string unit;
    std::optional<StreamKind> kind{};
};

/// A stream, as it will be written.
struct DraftStream {
    std::optional<StreamKind> kind;
    std::vector<const DraftColumn*> columns;
};

class Drafter {
public:
    Drafter(std::string text, const std::filesystem::path& table)
        : text_(std::move(text)), table_(table), head_(readCsvHead(std::string_view(text_).substr(0, 1 << 16), 0)) {}

    Result<RecordingDraft> draft() {
        if (!head_.firstRow) {
            return fail(ErrorCode::ParseError,
                        "{}: there is no row of numbers at its beginning; a table of sensor data, or a folder with "
                        "recording.json, was expected",
                        table_.string());
        }
        takeDecimalCommas();
        nameColumns();
        findTime();
        for (auto& column : columns_) {
            if (&column == time_) continue;
            column.kind = kindByUnit(column.unit);
            if (!column.kind) column.kind = kindByName(lowered(column.name));
        }
        chooseStreams();
        std::string streams;
        for (std::size_t i = 0; i < streams_.size(); ++i)
            streams += fmt::format("{}    {}", i == 0 ? "" : ",\n", entry(streams_[i], i));
        out_.json = fmt::format(
            "{{\n  \"title\": {},\n  \"source\": \"\",\n  \"licence\": \"\",\n  \"streams\": [\n{}\n  ]\n}}\n",
            dumpJson(table_.stem().string()), streams);
        return std::move(out_);
    }

private:
    /// If the header has a single cell, commas below it do not separate cells.
    void takeDecimalCommas() {
        auto& row = *head_.firstRow;
        const bool one = !head_.header.empty() && head_.header.back().fields.size() == 1;
        if (!one || head_.separator != ',' || row.fields.size() != 2) return;
        const auto joined = row.fields[0] + "," + row.fields[1];
        if (!fieldNumber(joined, ',')) return;
        row.fields = {joined};
        head_.separator = ';';
        head_.point = ',';
    }

    /// Takes names and units from the last lines before the first row that have as many cells as the row.
    void nameColumns() {
        std::size_t width = head_.firstRow->fields.size();
        while (width > 1 && head_.firstRow->fields[width - 1].empty()) --width;
        const auto isWide = [&](const CsvLine& line) {
            auto filled = line.fields.size();
            while (filled > 0 && line.fields[filled - 1].empty()) --filled;
            return filled == width || (filled > width && filled <= head_.firstRow->fields.size());
        };
        const auto& lines = head_.header;
        const auto isUnits = [&](const CsvLine& line) {
            bool any = false;
            for (const auto& field : line.fields) {
                const auto unit = withoutBrackets(field);
                const bool known = recordedTimeUnit(unit) || std::ranges::any_of(kStreamKinds, [&](const auto& kind) {
                                       return recordedUnit(kind.value, unit).has_value();
                                   });
                if (!known && !unit.empty()) return false;
                any = any || known;
            }
            return any;
        };
        const CsvLine* units = lines.size() > 1 && isUnits(lines.back()) ? &lines.back() : nullptr;
        const auto* names =
            lines.size() > (units != nullptr ? 1U : 0U) ? &*(lines.end() - (units != nullptr ? 2 : 1)) : nullptr;
        if (names != nullptr && !isWide(*names)) names = units = nullptr;
        if (names != nullptr) {
            width = std::max(width, std::min(names->fields.size(), head_.firstRow->fields.size()));
            const auto shown = std::span(names->fields).first(width);
            if (std::ranges::find(shown, std::string()) != shown.end() || secondIn(shown) != nullptr) {
                byNumber_ = true;
                out_.taken.push_back("the columns are called by number: the header leaves names out or repeats them");
            }
        }
        byNumber_ = byNumber_ || names == nullptr;
        for (std::size_t i = 0; i < width; ++i) {
            DraftColumn column;
            if (names != nullptr) {
                const auto header = headerName(names->fields[i]);
                column.name = header.name;
                column.unit = header.unit;
                if (units != nullptr && i < units->fields.size() && column.unit.empty())
                    column.unit = withoutBrackets(units->fields[i]);
            }
            column.called = byNumber_ ? Json(i + 1) : Json(names->fields[i]);
            columns_.push_back(std::move(column));
        }
    }

    std::vector<double> readColumn(std::size_t index) const {
        constexpr std::size_t kMaxRows = 5000;
        std::vector<double> values;
        CsvReader reader(text_, head_.firstRow->number - 1, head_.separator);
        while (values.size() < kMaxRows && reader.next()) {
            if (index >= reader.fields().size()) continue;
            if (const auto value = fieldNumber(reader.fields()[index], head_.point)) values.push_back(*value);
        }
        return values;
    }

    /// Finds the time column by its unit or name. Without names, it is a column that rises evenly next to others.
    void findTime() {
        for (auto& column : columns_) {
            if (time_ == nullptr && recordedTimeUnit(column.unit)) time_ = &column;
        }
        for (auto& column : columns_) {
            if (time_ == nullptr && column.unit.empty() && isTimeName(lowered(column.name))) time_ = &column;
        }
        if (time_ == nullptr && columns_.size() > 1 && columns_.front().name.empty()) {
            const auto values = readColumn(0);
            const bool rises =
                values.size() > 2 && std::ranges::adjacent_find(values, std::greater_equal()) == values.end();
            if (rises) {
                time_ = &columns_.front();
                out_.taken.push_back("column 1 is taken for the time: it rises from row to row");
            }
        }
        if (time_ == nullptr) return findRate();
        if (const auto unit = recordedTimeUnit(time_->unit)) {
            timeUnit_ = unit->spelled;
            return;
        }
        const double steps = roughRate_hz(readColumn(static_cast<std::size_t>(time_ - columns_.data())));
        constexpr double kSlowest_hz = 20, kFastest_hz = 20'000;  // a factor of 1000: only one unit of time fits
        for (const char* spelled : {"s", "ms", "us", "ns"}) {
            const double rate_hz = steps * recordedTimeUnit(spelled)->perSecond;
            if (!(rate_hz > kSlowest_hz && rate_hz <= kFastest_hz)) continue;
            timeUnit_ = spelled;
            out_.taken.push_back(
                fmt::format("times are taken to be in {}: the rows then come at {:.4g} Hz", spelled, rate_hz));
        }
    }

    /// Reads the rate from lines before the table or from remarks: "Sample rate: 4 kHz", "record_frequency,1000".
    void findRate() {
        std::vector<std::string> lines = head_.remarks;
        for (const auto& line : head_.header) lines.push_back(fmt::format("{}", fmt::join(line.fields, " ")));
        for (const auto& line : lines) {
            const auto words = lowered(line);
            const bool speaks = words.find("rate") != std::string::npos || words.find("freq") != std::string::npos ||
                                words.starts_with("fs");
            const auto digit = words.find_first_of("0123456789");
            if (!speaks || digit == std::string::npos) continue;
            auto rest = std::string_view(words).substr(digit);
            const auto number = takeNumber(rest);
            rest = trimmed(rest);
            if (!number || !(*number > 0)) continue;
            rate_hz_ = *number * (rest.starts_with("khz") ? 1000 : 1);
            out_.taken.push_back(fmt::format("the rate is taken from \"{}\"", line.substr(0, 60)));
            return;
        }
    }

    void chooseStreams() {
        std::string left;
        for (const auto& kind : kStreamKinds) {
            DraftStream stream{kind.value, {}};
            const std::size_t most = kind.value == StreamKind::Force          ? 1
                                     : kind.value == StreamKind::Acceleration ? 3
                                                                              : 1024;
            for (const auto& column : columns_) {
                if (column.kind != kind.value || &column == time_) continue;
                const bool another = !stream.columns.empty() && stream.columns.front()->unit != column.unit;
                if (stream.columns.size() < most && !another)
                    stream.columns.push_back(&column);
                else
                    left += fmt::format("{}{}", left.empty() ? "" : ", ", dumpJson(column.called));
            }
            if (kind.value == StreamKind::Taxels && stream.columns.size() == 1) stream.kind.reset();
            if (!stream.columns.empty()) streams_.push_back(std::move(stream));
        }
        DraftStream unknown;
        for (const auto& column : columns_) {
            if (!column.kind && &column != time_) unknown.columns.push_back(&column);
        }
        if (streams_.empty() && !unknown.columns.empty()) {
            if (unknown.columns.size() > 3) unknown.kind = StreamKind::Taxels;
            streams_.push_back(std::move(unknown));
        } else {
            for (const auto* column : unknown.columns)
                left += fmt::format("{}{}", left.empty() ? "" : ", ", dumpJson(column->called));
        }
        if (!left.empty()) out_.taken.push_back("not taken: " + left);
    }

    /// Returns the stream's line, and notes the values that it leaves open.
    std::string entry(const DraftStream& stream, std::size_t index) {
        const auto open = [&](const char* key, const std::string& accepted) {
            out_.open.push_back(fmt::format("streams[{}]: \"{}\": {}", index, key, accepted));
            return std::string("null");
        };
        auto columns = Json::array();
        TableLayout layout{.rate_hz = 1};
        for (const auto* column : stream.columns) {
            columns.push_back(column->called);
            layout.columns.push_back(choiceOf(*column));
        }
        std::string when;
        if (time_ != nullptr) {
            layout.timeColumn = choiceOf(*time_);
            const auto unit = timeUnit_ != nullptr ? dumpJson(timeUnit_) : open("time_unit", kRecordedTimeUnits);
            when = fmt::format("\"time_column\": {}, \"time_unit\": {}", dumpJson(time_->called), unit);
        } else {
            const auto rate =
                rate_hz_ ? fmt::format("{}", *rate_hz_)
                         : open("rate_hz", "how many rows there are in a second, which the table does not say");
            when = "\"rate_hz\": " + rate;
        }
        std::string more;
        if (byNumber_ && head_.firstRow->number > 1) {
            layout.skipRows = head_.firstRow->number - 1;
            more += fmt::format(", \"skip_rows\": {}", layout.skipRows);
        }
        if (const auto read = readTable(text_, table_.string(), layout);
            !read && read.error().message.find("\"decimal\"") != std::string::npos) {
            more += ", \"decimal\": " + open("decimal",
                                             "\",\" where 0,5 is one number and the only column is 1, \".\" "
                                             "where it is two");
        }
        const auto kind =
            stream.kind
                ? dumpJson(nameOf(*stream.kind))
                : open("kind", "acceleration, force or taxels, as what column " + dumpJson(columns.front()) + " holds");
        const auto written = stream.kind ? recordedUnit(*stream.kind, stream.columns.front()->unit) : std::nullopt;
        std::string unit = written ? dumpJson(written->spelled) : std::string();
        if (!written) {
            unit = open("unit", stream.kind ? fmt::format("one of {}", fmt::join(unitsOf(*stream.kind), ", "))
                                            : std::string("the unit of its numbers, count where it is not known"));
        }
        return fmt::format("{{\"kind\": {}, \"file\": {}, {}{},\n     \"columns\": {}, \"unit\": {}}}", kind,
                           dumpJson(table_.filename().string()), when, more, dumpJson(columns), unit);
    }

    static ColumnChoice choiceOf(const DraftColumn& column) {
        if (column.called.is_string()) return column.called.get<std::string>();
        return column.called.get<std::size_t>();
    }

    const std::string text_;
    const std::filesystem::path& table_;
    CsvHead head_;
    std::vector<DraftColumn> columns_;
    bool byNumber_ = false;
    const DraftColumn* time_ = nullptr;
    const char* timeUnit_ = nullptr;
    std::optional<double> rate_hz_;
    std::vector<DraftStream> streams_;
    RecordingDraft out_;
};

}  // namespace

Result<RecordingDraft> draftRecording(const std::filesystem::path& table, const SignalReader& reader) {
    if (reader) {
        const auto signals = reader(table);
        if (!signals) return failure(signals);
        if (*signals) return draftSignals(**signals, table);
    }
    auto content = readTextFile(table);
    if (!content) return failure(content);
    auto text = asUtf8(*content);
    constexpr std::string_view kByteOrderMark = "\xEF\xBB\xBF";
    if (text.starts_with(kByteOrderMark)) text.erase(0, kByteOrderMark.size());
    return Drafter(std::move(text), table).draft();
}

}  // namespace tacto
