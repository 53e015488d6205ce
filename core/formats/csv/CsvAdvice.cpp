#include "core/formats/csv/CsvAdvice.h"

#include <algorithm>
#include <cmath>
#include <fmt/ranges.h>

#include "core/base/CsvStamp.h"
#include "core/formats/csv/CsvColumns.h"
#include "core/formats/csv/CsvMakers.h"

namespace tacto {

namespace {

/// Column numbers, from 1, by the contents of the first rows.
struct ColumnsOfRows {
    std::vector<std::size_t> numbers;  ///< columns without text
    std::vector<std::size_t> rising;   ///< columns among these that rise in even steps, as times and stamps do
};

bool risesEvenly(const std::vector<double>& values) {
    if (values.size() < 2) return false;
    const double step = (values.back() - values.front()) / static_cast<double>(values.size() - 1);
    if (!(step > 0)) return false;
    for (std::size_t i = 1; i < values.size(); ++i) {
        if (!(std::abs(values[i] - values[i - 1] - step) <= 0.3 * step)) return false;
    }
    return true;
}

ColumnsOfRows columnsOf(const CsvHead& head) {
    constexpr std::size_t kMaxColumns = 12;
    ColumnsOfRows columns;
    const auto width = head.firstRow ? std::min(filled(*head.firstRow), kMaxColumns) : 0;
    for (std::size_t c = 0; c < width; ++c) {
        std::vector<double> values;
        std::size_t stamps = 0;
        std::size_t texts = 0;
        for (const auto& line : head.body) {
            if (c >= line.fields.size() || line.fields[c].empty()) continue;
            if (const auto number = fieldNumber(line.fields[c], head.point)) {
                values.push_back(*number);
            } else {
                ++(fieldStamp(line.fields[c], head.point) ? stamps : texts);
            }
        }
        if (texts == 0 && values.empty() && stamps > 0) columns.rising.push_back(c + 1);
        if (texts > 0 || values.empty()) continue;
        columns.numbers.push_back(c + 1);
        if (risesEvenly(values)) columns.rising.push_back(c + 1);
    }
    return columns;
}

/// Returns numbers of lines to skip so that a table begins with its column names.
std::vector<std::size_t> skipsOf(const CsvHead& head, std::size_t given) {
    constexpr std::size_t kMaxSkips = 6;
    std::vector<std::size_t> skips;
    for (const auto* lines : {&head.header, &head.body}) {
        for (const auto& line : *lines) {
            const bool names =
                filled(line) > 1 && !isLineOfUnits(line) &&
                std::ranges::any_of(line.fields, [](const auto& field) { return isTimeColumn(columnNamed(field)); });
            if (names && line.number > given + 1 && skips.size() < kMaxSkips) skips.push_back(line.number - 1);
        }
    }
    return skips;
}

class Trials {
public:
    Trials(std::string_view text, CsvDialect dialect, const ReadOptions& given, std::string_view file)
        : given_(given),
          head_(readCaptureHead(text, given.skipRows)),
          columns_(columnsOf(head_)),
          file_(file),
          dialect_(dialect) {}

    std::vector<CsvAdvice> take() {
        const auto layout = layOut(dialect_, head_, given_, file_);
        if (layout) {  // a row was refused: suggests the columns without such a row
            if (!layout->otherTimes.empty()) addOwnTimes(*layout);
            for (const auto& channel : layout->channels) {
                auto options = given_;
                options.columns.clear();
                for (const auto& other : layout->channels) {
                    if (other.number != channel.number) options.columns.push_back(fmt::to_string(other.number));
                }
                if (!options.columns.empty()) add(options);
            }
            return std::move(all_);
        }
        for (const auto skip : skipsOf(head_, given_.skipRows)) {
            auto options = given_;
            options.skipRows = skip;
            add(options);
        }
        addAll(dialect_, given_);
        if (dialect_ != CsvDialect::Plain && given_.format != "csv") {
            auto plain = given_;
            plain.format = "csv";
            add(plain);
            addAll(CsvDialect::Plain, plain);
        }
        return std::move(all_);
    }

private:
    /// Suggests the channels after the first time column, which share its times.
    void addOwnTimes(const CsvLayout& layout) {
        auto options = given_;
        options.columns.clear();
        for (const auto& channel : layout.channels) {
            if (channel.number > layout.timeColumn + 1 && channel.number < layout.otherTimes.front().column + 1) {
                options.columns.push_back(fmt::to_string(channel.number));
            }
        }
        if (!options.columns.empty()) add(options);
    }

    void addAll(CsvDialect dialect, const ReadOptions& base) {
        timeOfFile_ = timeColumnOf(dialect, base);
        addColumns(base);
        for (const auto column : columns_.numbers) {
            auto options = base;
            if (options.units.try_emplace(fmt::to_string(column), "V").second) add(options, ", its numbers as volts");
        }
        for (const auto time : columns_.rising) {
            if (timeOfFile_ != 0 && (timeOfFile_ != time || base.timeColumn.empty())) continue;
            auto options = base;
            options.timeColumn = fmt::to_string(time);
            if (options.timeColumn == given_.timeColumn || isIndex(time, dialect)) continue;
            const std::string_view how = timeOfFile_ == 0 ? ", its numbers as seconds" : "";
            add(options, how);
            addColumns(options, how);
        }
        if (timeOfFile_ != 0) return;
        if (given_.rate) return;
        const auto stated = intervalStated(head_);
        auto options = base;
        options.rate = Hertz(stated ? 1 / stated->interval_s : 1);
        rateIsKnown_ = stated.has_value();
        add(options);
        addColumns(options);
    }

    /// Returns the column that the file calls the time, or 0 if there is none.
    [[nodiscard]] std::size_t timeColumnOf(CsvDialect dialect, ReadOptions options) const {
        options.timeColumn.clear();
        options.units.clear();
        for (const auto number : columns_.numbers) {
            options.columns = {fmt::to_string(number)};
            const auto layout = layOut(dialect, head_, options, file_);
            if (layout && layout->times != RowTimes::Counted) return layout->timeColumn + 1;
        }
        return 0;
    }

    /// Returns whether the column holds row numbers or a channel, not times.
    [[nodiscard]] bool isIndex(std::size_t column, CsvDialect dialect) const {
        const auto named = [&](const CsvLine& line) {
            if (column > line.fields.size()) return false;
            const auto& name = line.fields[column - 1];
            return isIndexColumn(columnNamed(name)) || folded(name).starts_with("ch");
        };
        if (std::ranges::any_of(head_.header, named)) return true;
        const auto isNext = [&](const CsvLine& row, const CsvLine& next) {
            if (column > std::min(row.fields.size(), next.fields.size())) return false;
            const auto number = fieldNumber(row.fields[column - 1], head_.point);
            return number && fieldNumber(next.fields[column - 1], head_.point) == *number + 1;
        };
        return dialect != CsvDialect::Plain && head_.body.size() > 1 && isNext(head_.body[0], head_.body[1]);
    }

    /// Suggests all columns that hold numbers.
    void addColumns(ReadOptions options, std::string_view how = "") {
        options.columns.clear();
        for (const auto number : columns_.numbers) {
            if (fmt::to_string(number) == options.timeColumn || number == timeOfFile_) continue;
            options.columns.push_back(fmt::to_string(number));
        }
        if (!options.columns.empty() && options.columns != given_.columns) add(options, how);
    }

    void add(const ReadOptions& options, std::string_view how = "") {
        std::vector<std::string> words;
        if (options.format != given_.format) words.push_back("--format " + options.format);
        if (options.skipRows != given_.skipRows) words.push_back(fmt::format("--skip-rows {}", options.skipRows));
        if (options.timeColumn != given_.timeColumn) words.push_back("--time-column " + options.timeColumn);
        if (options.columns != given_.columns)
            words.push_back(fmt::format("--columns {}", fmt::join(options.columns, ",")));
        for (const auto& [channel, unit] : options.units) {
            if (!given_.units.contains(channel)) words.push_back(fmt::format("--unit {}={}", channel, unit));
        }
        const bool rated = options.rate.has_value() && !given_.rate;
        if (rated && rateIsKnown_) words.push_back(fmt::format("--sample-rate {:.10g}", options.rate->value()));
        if (rated && !rateIsKnown_) words.emplace_back("--sample-rate HZ");
        if (words.empty()) return;
        all_.push_back({options, fmt::format("{} reads it{}{}", fmt::join(words, " "), how,
                                             rated && !rateIsKnown_ ? ", where HZ is the instrument's rate" : "")});
    }

    const ReadOptions& given_;
    const CsvHead head_;
    const ColumnsOfRows columns_;
    const std::string_view file_;
    const CsvDialect dialect_;
    std::size_t timeOfFile_ = 0;
    bool rateIsKnown_ = false;
    std::vector<CsvAdvice> all_;
};

}  // namespace

std::vector<CsvAdvice> adviceToTry(std::string_view text, CsvDialect dialect, const ReadOptions& given,
                                   std::string_view file) {
    return Trials(text, dialect, given, file).take();
}

}  // namespace tacto
