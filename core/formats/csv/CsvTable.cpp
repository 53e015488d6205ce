#include "core/formats/csv/CsvTable.h"

#include <algorithm>
#include <bit>
#include <cmath>
#include <limits>

#include "core/formats/csv/CsvChanges.h"
#include "core/formats/csv/CsvRows.h"
#include "core/formats/csv/CsvTimes.h"

namespace tacto {

namespace {

/// Whether all are finite, without a branch for each: their exponents are asked.
bool allFinite(const float* samples, std::size_t count) {
    constexpr std::uint32_t kExponent = 0x7F800000U;
    std::uint32_t highest = 0;
    for (std::size_t i = 0; i < count; ++i) {
        highest = std::max(highest, std::bit_cast<std::uint32_t>(samples[i]) & kExponent);
    }
    return highest != kExponent;
}

struct Missing {
    std::size_t row = std::numeric_limits<std::size_t>::max();  ///< the first
    std::size_t line = 0;
};

/// The table as it grows.
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

    /// Notes the first row whose channels have other times.
    void compareTimes(const RowBatch& batch, const CsvLayout& layout) {
        constexpr double kAgreeing = 0.05;  // share of a step: rounding, and nothing that a pulse's edges would show
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
                // What follows may be the padded end: the times are judged without it then.
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

    /// Drops the rows at the end, says what is missing.
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
            // Beyond a float is beyond any oscilloscope: as missing as nan.
            std::ranges::replace_if(
                samples, [](float sample) { return !std::isfinite(sample); }, std::numeric_limits<float>::quiet_NaN());
        }
    }

    struct Difference {
        std::size_t line = 0;  ///< 0: none
        std::size_t column = 0;
        double by_s = 0;
    };
    CsvTimes times;
    Difference differing;  ///< the first of other times
    std::size_t rows = 0;
    std::size_t rowsWithValues = 0;
    std::size_t lastLine = 0;
    std::size_t firstEmptyLine = 0;

private:
    /// Whether row `i` of the batch has any value; notes the channels that have none.
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

/// The stamps once more, where they are not plainly even.
Result<void> readTimesAgain(TextBlocks& blocks, const CsvHead& head, const CsvLayout& layout, const ReadWatch& watch,
                            CsvTimes& times) {
    CsvLayout timesOnly = layout;
    timesOnly.channels.clear();
    if (auto back = blocks.rewind(); !back) return back;
    CsvRows rows(timesOnly, head.separator, head.point, blocks);
    times.startAgain();
    while (!times.hasAll()) {
        const auto batch = rows.next({{}, watch.stop});  // its progress is behind it
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
    // Where columns were left out, rows may be the changes of those.
    const bool ofMore = isTimed && channels.size() + 1 < layout.width && growing.times.hasAll();
    const bool drawn = changes || (ofMore && listsChangesOfMore(channels, growing.times.stamps()));
    if (drawn && layout.givenRate_hz) {
        return fail(ErrorCode::InvalidArgument,
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
