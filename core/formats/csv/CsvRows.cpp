#include "core/formats/csv/CsvRows.h"

#include <algorithm>
#include <bit>
#include <cmath>
#include <cstring>
#include <limits>

#include "core/base/Csv.h"
#include "core/base/CsvHead.h"
#include "core/base/CsvStamp.h"
#include "core/base/Utf16.h"
#include "core/formats/csv/CsvChanges.h"
#include "core/formats/csv/CsvTimes.h"

namespace tacto {

namespace {

const char* overBlanks(const char* text, char separator) {
    while (*text == ' ' || (*text == '\t' && separator != '\t')) ++text;
    return text;
}

}  // namespace

CsvRows::CsvRows(const CsvLayout& layout, char separator, char point, TextBlocks& blocks)
    : layout_(layout),
      separator_(separator),
      point_(point),
      blocks_(blocks),
      uses_(layout.width),
      line_(layout.dataLine),
      skip_(layout.dataOffset) {
    if (layout.times != RowTimes::Counted) {
        batch_.times.resize(RowBatch::kRows);
        uses_[layout.timeColumn].ignored = false;
        uses_[layout.timeColumn].stamps = layout.stampOrigin.has_value();
    }
    for (std::size_t k = 0; k < layout.otherTimes.size(); ++k) {
        auto& use = uses_[layout.otherTimes[k].column];
        use.ignored = false;
        use.channel = Use::kOther + k;
        batch_.others.emplace_back(RowBatch::kRows);
    }
    batch_.channels.assign(layout.channels.size(), std::vector<float>(RowBatch::kRows));
    batch_.lines.resize(RowBatch::kRows);
    for (std::size_t c = 0; c < layout.channels.size(); ++c) {
        const auto& channel = layout.channels[c];
        auto& use = uses_[channel.number - 1];
        use.ignored = false;
        use.channel = c;
        use.factor = channel.factor;
    }
    for (auto& use : uses_) use.values.resize(RowBatch::kRows);
}

double CsvRows::bytesPerRow() const noexcept {
    return rows_ == 0 ? 0 : static_cast<double>(bytes_) / static_cast<double>(rows_);
}

Result<const RowBatch*> CsvRows::next(const ReadWatch& watch) {
    batch_.rows = 0;
    while (batch_.rows < RowBatch::kRows && endLine_ == 0) {
        if (text_.empty()) {
            const auto block = blocks_.next();
            if (!block) return failure(block);
            if (auto going = keepReading(watch, blocks_.fraction(), blocks_.name()); !going) return failure(going);
            if (block->empty()) break;
            text_ = block->substr(std::min(skip_, block->size()));
            skip_ -= std::min(skip_, block->size());
            continue;
        }
        if (auto taken = takeRows(); !taken) return failure(taken);
    }
    rows_ += batch_.rows;
    deliver();
    return &batch_;
}

Result<void> CsvRows::takeRows() {
    const char* text = text_.data();
    const char* const end = text + text_.size();
    const bool mayEnd = !layout_.endsAt.empty();
    while (text != end && batch_.rows < RowBatch::kRows) {
        const std::size_t row = batch_.rows;
        if (mayEnd && std::string_view(text, static_cast<std::size_t>(end - text)).starts_with(layout_.endsAt)) {
            endLine_ = line_;
            break;
        }
        if (const char* const next = takePlainRow(text, end, row)) {
            batch_.lines[row] = line_++;
            ++batch_.rows;
            text = next;
            continue;
        }
        const auto length = static_cast<std::size_t>(
            static_cast<const char*>(std::memchr(text, '\n', static_cast<std::size_t>(end - text))) - text);
        const std::string_view line(text, length);
        if (!isPassedOver(line)) {
            if (auto taken = takeFields(line, row); !taken) return taken;
            batch_.lines[row] = line_;
            ++batch_.rows;
        }
        ++line_;
        text += length + 1;
    }
    bytes_ += static_cast<std::uint64_t>(text - text_.data());
    text_.remove_prefix(static_cast<std::size_t>(text - text_.data()));
    return {};
}

const char* CsvRows::takePlainRow(const char* text, const char* end, std::size_t row) {
    const char separator = separator_;
    const char point = point_;
    for (Use* use = uses_.data(); use != uses_.data() + uses_.size(); ++use) {
        if (use != uses_.data() && *text++ != separator) return nullptr;
        text = overBlanks(text, separator);
        if (use->ignored) {
            while (*text != separator && *text != '\n' && *text != '"' && !(*text == '\t' && separator == ' ')) ++text;
            if (*text == '"') return nullptr;
        } else {
            text =
                use->stamps ? takeStampOf(text, end, use->values[row]) : takeNumber(text, end, point, use->values[row]);
            if (text == nullptr) return nullptr;
            if (separator != ' ') text = overBlanks(text, separator);
        }
    }
    while (*text == separator) text = overBlanks(text + 1, separator);
    if (*text == '\r') ++text;
    return *text == '\n' ? text + 1 : nullptr;
}

const char* CsvRows::takeStampOf(const char* text, const char* end, double& value) const {
    CsvStamp stamp;
    const char* const behind = takeStamp(text, end, point_, stamp);
    value = stamp.since(*layout_.stampOrigin);
    return behind;
}

void CsvRows::deliver() {
    constexpr double kNone = std::numeric_limits<double>::quiet_NaN();
    for (auto& use : uses_) {
        if (use.ignored) continue;
        const double* const from = use.values.data();
        if (use.channel >= Use::kOther) {
            auto& times = use.channel == Use::kTime ? batch_.times : batch_.others[use.channel - Use::kOther];
            std::ranges::transform(from, from + batch_.rows, times.begin(),
                                   [](double time) { return isNoValue(time) ? kNone : time; });
            continue;
        }
        float* const into = batch_.channels[use.channel].data();
        std::size_t none = 0;
        for (std::size_t i = 0; i < batch_.rows; ++i) {
            into[i] = static_cast<float>(from[i] * use.factor);
            none += isNoValue(from[i]) ? 1U : 0U;
        }
        if (none == 0) continue;
        for (std::size_t i = 0; i < batch_.rows; ++i) {
            if (!isNoValue(from[i])) continue;
            into[i] = std::numeric_limits<float>::quiet_NaN();
            if (std::isfinite(from[i])) ++use.noValues;
        }
    }
}

Result<void> CsvRows::takeFields(std::string_view line, std::size_t row) {
    cutRow(line, separator_, fields_);
    const std::size_t width = uses_.size();
    bool surplus = false;
    for (std::size_t i = width; i < fields_.size(); ++i) surplus = surplus || !fields_[i].empty();
    const auto hasPoint = [](std::string_view field) { return field.find('.') != std::string_view::npos; };
    if (separator_ == ',' && surplus && fields_.size() == 2 * width && std::ranges::none_of(fields_, hasPoint)) {
        return fail(
            ErrorCode::Unsupported,
            "{}:{}: {} fields, where the header has {}: decimal commas cannot be told from commas between columns; "
            "decimal points, or semicolons between columns, were expected",
            blocks_.name(), line_, fields_.size(), width);
    }
    if (fields_.size() < width || (surplus && !layout_.mayEndInText)) {
        return fail(ErrorCode::ParseError, "{}:{}: {} fields; {} were expected, as in the header", blocks_.name(),
                    line_, fields_.size(), width);
    }
    for (std::size_t c = 0; c < width; ++c) {
        if (uses_[c].ignored) continue;
        std::optional<double> value = std::numeric_limits<double>::quiet_NaN();
        if (uses_[c].stamps && !fields_[c].empty()) {
            const auto stamp = fieldStamp(fields_[c], point_);
            value = stamp ? std::optional(stamp->since(*layout_.stampOrigin)) : std::nullopt;
        } else if (!fields_[c].empty()) {
            value = fieldNumber(fields_[c], point_);
        }
        if (!value) {
            return fail(ErrorCode::ParseError, "{}:{}: '{}' in column '{}'; {} was expected", blocks_.name(), line_,
                        latin1AsUtf8(fields_[c].substr(0, 40)), layout_.names[c],
                        uses_[c].stamps ? "a date and time, as in the first row," : "a number");
        }
        sawInfinite_ = sawInfinite_ || std::isinf(*value);
        uses_[c].values[row] = *value;
    }
    return {};
}

namespace {

/// Returns whether all samples are finite. Combines their exponents, which needs no branch per sample.
bool allFinite(const float* samples, std::size_t count) {
    constexpr std::uint32_t kExponent = 0x7F800000U;
    std::uint32_t highest = 0;
    for (std::size_t i = 0; i < count; ++i) {
        highest = std::max(highest, std::bit_cast<std::uint32_t>(samples[i]) & kExponent);
    }
    return highest != kExponent;
}

struct Missing {
    std::size_t row = std::numeric_limits<std::size_t>::max();  ///< the first such row
    std::size_t line = 0;
};

/// The capture while its rows are being read.
class Growing {
public:
    Growing(const CsvLayout& layout, CaptureReading& into)
        : times(layout), channels_(into.capture.channels), missing_(layout.channels.size()) {
        for (const auto& plan : layout.channels) {
            CaptureChannel channel;
            channel.name = plan.name;
            channel.unit = plan.unit;
            channel.low = plan.low;
            channel.high = plan.high;
            channels_.push_back(std::move(channel));
        }
    }

    /// Notes the first row in which channels have different times.
    void compareTimes(const RowBatch& batch, const CsvLayout& layout) {
        constexpr double kAgreeing = 0.05;  // share of a step: rounding, too little to show at a pulse's edges
        if (rows == 0 && batch.rows > 1 && !batch.others.empty()) {
            agreeing_s_ = kAgreeing * std::abs(batch.times[batch.rows - 1] - batch.times[0]) * layout.timeFactor /
                          static_cast<double>(batch.rows - 1);
        }
        for (std::size_t i = 0; i < batch.rows && differing.line == 0; ++i) {
            for (std::size_t k = 0; k < batch.others.size(); ++k) {
                const auto& other = layout.otherTimes[k];
                const double off = std::abs(batch.others[k][i] * other.factor - batch.times[i] * layout.timeFactor);
                if (off > agreeing_s_) differing = {batch.lines[i], other.column, off};
            }
        }
    }

    void reserve(std::size_t expected) {
        for (auto& channel : channels_) channel.samples.reserve(expected);
    }

    void add(const RowBatch& batch) {
        if (batch.rows == 0) return;
        bool complete = true;
        for (std::size_t c = 0; c < channels_.size(); ++c) {
            const auto& from = batch.channels[c];
            complete = complete && allFinite(from.data(), batch.rows);
            channels_[c].samples.insert(channels_[c].samples.end(), from.begin(),
                                        from.begin() + static_cast<std::ptrdiff_t>(batch.rows));
        }
        if (complete) {
            if (!batch.times.empty()) {
                times.add(std::span(batch.times).first(batch.rows), std::span(batch.lines).first(batch.rows));
            }
            rows += batch.rows;
            rowsWithValues = rows;
            lastLine = batch.lines[batch.rows - 1];
            return;
        }
        for (std::size_t i = 0; i < batch.rows; ++i) {
            const bool valued = look(batch, i);
            if (!valued && rowsWithValues == rows) {
                // Padding may begin here; if so, the times after this point are ignored.
                times.keep();
                firstEmptyLine = batch.lines[i];
            }
            if (!batch.times.empty())
                times.add(std::span(batch.times).subspan(i, 1), std::span(batch.lines).subspan(i, 1));
            ++rows;
            lastLine = batch.lines[i];
            if (valued) rowsWithValues = rows;
        }
    }

    /// Drops empty rows at the end and warns about missing values.
    void finish(const CsvLayout& layout, std::string_view file, std::vector<std::string>& warnings) {
        if (rowsWithValues < rows) {
            times.dropBehindKept();
            warnings.push_back(
                fmt::format("{}:{}: {} without values at the end left out", file, firstEmptyLine,
                            rows - rowsWithValues == 1 ? "a row" : fmt::format("{} rows", rows - rowsWithValues)));
        }
        for (std::size_t c = 0; c < channels_.size(); ++c) {
            auto& samples = channels_[c].samples;
            samples.resize(rowsWithValues);
            if (missing_[c].row >= rowsWithValues) continue;
            const auto count = std::ranges::count_if(samples, [](float sample) { return !std::isfinite(sample); });
            warnings.push_back(fmt::format(
                "{}:{}: column '{}' has no finite value here{}; pulses that touch a missing sample are not measured",
                file, missing_[c].line, layout.names[layout.channels[c].number - 1],
                count == 1 ? "" : fmt::format(", and in {} rows in all", count)));
            // A value too large for a float is too large for any oscilloscope: it is missing, like nan.
            std::ranges::replace_if(
                samples, [](float sample) { return !std::isfinite(sample); }, std::numeric_limits<float>::quiet_NaN());
        }
    }

    struct Difference {
        std::size_t line = 0;  ///< 0: no such line
        std::size_t column = 0;
        double by_s = 0;
    };
    CsvTimes times;
    Difference differing;  ///< the first difference between times
    std::size_t rows = 0;
    std::size_t rowsWithValues = 0;
    std::size_t lastLine = 0;
    std::size_t firstEmptyLine = 0;

private:
    /// Returns whether row `i` of the batch has any value. Notes the channels without one.
    bool look(const RowBatch& batch, std::size_t i) {
        bool valued = false;
        for (std::size_t c = 0; c < channels_.size(); ++c) {
            if (std::isfinite(batch.channels[c][i])) {
                valued = true;
            } else if (rows < missing_[c].row) {
                missing_[c] = {rows, batch.lines[i]};
            }
        }
        return valued;
    }

    std::vector<CaptureChannel>& channels_;
    std::vector<Missing> missing_;
    double agreeing_s_ = 0;
};

/// Reads the stamps again if they are not plainly even.
Result<void> readTimesAgain(TextBlocks& blocks, const CsvHead& head, const CsvLayout& layout, const ReadWatch& watch,
                            CsvTimes& times) {
    CsvLayout timesOnly = layout;
    timesOnly.channels.clear();
    if (auto back = blocks.rewind(); !back) return back;
    CsvRows rows(timesOnly, head.separator, head.point, blocks);
    times.startAgain();
    while (!times.hasAll()) {
        const auto batch = rows.next({{}, watch.stop});  // without progress, which was already reported
        if (!batch) return failure(batch);
        if ((*batch)->rows == 0) return fail(ErrorCode::Io, "{} became shorter while it was read", blocks.name());
        times.addAgain(std::span((*batch)->times).first((*batch)->rows));
    }
    return {};
}

}  // namespace

Result<CaptureReading> readCsvTable(TextBlocks& blocks, const CsvHead& head, const CsvLayout& layout,
                                    const ReadWatch& watch) {
    CaptureReading reading;
    reading.warnings = layout.warnings;
    Growing growing(layout, reading);
    CsvRows rows(layout, head.separator, head.point, blocks);
    for (;;) {
        const auto batch = rows.next(watch);
        if (!batch) return failure(batch);
        if ((*batch)->rows == 0) break;
        growing.compareTimes(**batch, layout);
        growing.add(**batch);
        if (growing.rows == (*batch)->rows) {
            growing.reserve(static_cast<std::size_t>(1.02 * static_cast<double>(blocks.size()) / rows.bytesPerRow()) +
                            RowBatch::kRows);
        }
    }
    if (rows.endLine() != 0) {
        reading.warnings.push_back(
            fmt::format("{}:{}: another segment begins here; it was not read", blocks.name(), rows.endLine()));
    }
    if (growing.rows == 0) {
        return fail(ErrorCode::ParseError, "{}: nothing after the header line; rows of numbers were expected",
                    blocks.name());
    }
    const std::size_t found = growing.rowsWithValues;
    growing.finish(layout, blocks.name(), reading.warnings);
    if (found < 2) {
        return fail(ErrorCode::ParseError, "{}:{}: {} row(s) with values; at least 2 were expected", blocks.name(),
                    growing.lastLine, found);
    }
    for (std::size_t c = 0; c < layout.channels.size(); ++c) {
        if (rows.noValues(c) == 0) continue;
        reading.warnings.push_back(noValueWarning(blocks.name(), layout.channels[c].name, rows.noValues(c)));
    }
    if (rows.sawInfinite()) {
        reading.warnings.push_back(fmt::format(
            "{}: some values are infinite, which means beyond the range; they are missing samples", blocks.name()));
    }
    if (layout.rows && !layout.otherRows.empty() && *layout.rows != static_cast<double>(found)) {
        return fail(ErrorCode::Unsupported, "{}: {} rows, where the header announces {}: {}", blocks.name(), found,
                    *layout.rows, layout.otherRows);
    }
    if (layout.rows && *layout.rows != static_cast<double>(found)) {
        reading.warnings.push_back(
            fmt::format("{}: the header announces {} rows; there are {}", blocks.name(), *layout.rows, found));
    }
    const auto& channels = reading.capture.channels;
    const bool isTimed = layout.times == RowTimes::Column && !growing.times.keepToStated();
    const bool changes = isTimed && listsChanges(channels);
    if (growing.times.needsAll() || (changes && !growing.times.hasAll())) {
        if (auto again = readTimesAgain(blocks, head, layout, watch, growing.times); !again) return failure(again);
    }
    // If columns were left out, the rows may be changes in those.
    const bool ofMore = isTimed && channels.size() + 1 < layout.width && growing.times.hasAll();
    const bool drawn = changes || (ofMore && listsChangesOfMore(channels, growing.times.stamps()));
    if (drawn && layout.givenRate_hz) {
        return invalid(
            "{}: it lists changes of level and not samples, so it has no sampling rate; without the option the "
            "levels between the changes are read",
            blocks.name());
    }
    const auto timed =
        drawn ? drawLevels(growing.times.stamps(), reading, blocks.name()) : growing.times.into(reading, blocks.name());
    if (!timed) return failure(timed);
    if (growing.differing.line != 0) {
        const auto& [line, column, by_s] = growing.differing;
        return fail(ErrorCode::ParseError,
                    "{}:{}: the times of column {} ('{}') differ by {:.3g} s from those of column {} here; columns of "
                    "times that agree, or the channels of one of them, were expected",
                    blocks.name(), line, column + 1, layout.names[column], by_s, layout.timeColumn + 1);
    }
    reading.capture.trigger_s = std::numeric_limits<double>::quiet_NaN();
    return reading;
}

}  // namespace tacto
