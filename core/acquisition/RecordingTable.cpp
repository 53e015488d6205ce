#include "core/acquisition/RecordingTable.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "core/acquisition/RecordingUnits.h"
#include "core/acquisition/StreamHealth.h"
#include "core/base/Csv.h"
#include "core/base/CsvHead.h"
#include "core/base/LocaleFreeText.h"
#include "core/base/Utf16.h"

namespace tacto {

namespace {

constexpr std::size_t kLongestQuote = 40;   // characters of the file's own text quoted in a message
constexpr std::size_t kHeadLines = 1000;    // lines in which a header is searched
constexpr std::size_t kLookedAt = 1 << 16;  // bytes examined to find a table's format

std::string excerpt(std::string_view cell) {
    auto out = latin1AsUtf8(cell.substr(0, kLongestQuote));
    for (auto& c : out) {
        if (static_cast<unsigned char>(c) < 0x20) c = '?';
    }
    return cell.size() > kLongestQuote ? out + "..." : out;
}

std::string joined(const std::vector<std::string>& names) {
    constexpr std::size_t kMaxNames = 12;
    std::string out;
    for (std::size_t i = 0; i < std::min(names.size(), kMaxNames); ++i) out += (i == 0 ? "" : ", ") + excerpt(names[i]);
    return names.size() > kMaxNames ? out + ", ..." : out;
}

std::string wordsFor(const ColumnChoice& column) {
    if (const auto* name = std::get_if<std::string>(&column)) return fmt::format("column \"{}\"", *name);
    return fmt::format("column {}", std::get<std::size_t>(column));
}

bool allEmpty(const std::vector<std::string_view>& fields, std::size_t from = 0) {
    return std::all_of(fields.begin() + static_cast<std::ptrdiff_t>(std::min(from, fields.size())), fields.end(),
                       [](std::string_view field) { return field.empty(); });
}

/// Returns whether the texts on both sides of a comma may be one number: "-0,04".
bool mayBeOneNumber(std::string_view first, std::string_view second) {
    constexpr std::string_view kDigits = "0123456789";
    if (first.starts_with('-') || first.starts_with('+')) first.remove_prefix(1);
    return !first.empty() && !second.empty() && first.find_first_not_of(kDigits) == std::string_view::npos &&
           second.find_first_not_of(kDigits) == std::string_view::npos;
}

/// Finds the first row of a table and the cells to be read in each row.
class TableReader {
public:
    TableReader(std::string_view text, std::string_view name, const TableLayout& layout)
        : text_(text), name_(name), layout_(layout) {
        if (layout.timeColumn) wanted_.push_back(*layout.timeColumn);
        wanted_.insert(wanted_.end(), layout.columns.begin(), layout.columns.end());
        head_ = readCsvHead(text.substr(0, kLookedAt), layout.skipRows);
        separator_ = head_.separator;
    }

    Result<SampleBlock> read() {
        if (const auto found = locate(); !found) return failure(found);
        CsvReader reader(text_, skip_, separator_);
        if (auto passed = passUnits(reader); !passed) return failure(passed);
        findDecimal();
        reader = CsvReader(text_, skip_, separator_);
        while (reader.next()) {
            // If a line is a single cell, or only tabs separate cells, a blank line is a row and takes up time.
            if (!layout_.timeColumn && (width_ == 1 || separator_ == '\t') && rows_ > 0) {
                const std::vector<std::string_view> nothing(width_);
                for (std::size_t i = 0; i < reader.blanksBefore(); ++i) (void)take(nothing, reader.line());
            }
            if (layout_.timeColumn && allEmpty(reader.fields())) continue;
            if (auto taken = take(reader.fields(), reader.line()); !taken) return failure(taken);
        }
        dropRowsOfOthers();
        if (out_.samples() < 2) {
            return fail(ErrorCode::ParseError, "{}:{}: the file ends after {} data rows; at least 2 were expected",
                        name_, reader.line(), out_.samples());
        }
        return std::move(out_);
    }

private:
    template <class... Args>
    tl::unexpected<Error> refuse(std::size_t line, fmt::format_string<Args...> text, Args&&... args) const {
        return fail(ErrorCode::ParseError, "{}:{}: {}", name_, line, fmt::format(text, std::forward<Args>(args)...));
    }

    Result<void> locate() {
        const bool named =
            std::ranges::any_of(wanted_, [](const auto& w) { return std::holds_alternative<std::string>(w); });
        if (head_.header.empty() && !head_.firstRow) {
            return refuse(
                1, "the file is empty{}; a header line naming {}, or rows of numbers, were expected",
                layout_.skipRows > 0 ? fmt::format(" behind the {} lines of \"skip_rows\"", layout_.skipRows) : "",
                wordsFor(wanted_.front()));
        }
        return named ? locateByName() : locateByNumber();
    }

    /// Finds the first line that contains all the column names; messages refer to the line that contains most of them.
    Result<void> locateByName() {
        std::size_t most = 0;
        std::size_t line = head_.header.empty() ? head_.firstRow->number : head_.header.back().number;
        auto names = head_.header.empty() ? std::vector<std::string>{} : head_.header.back().fields;
        for (const char separator : {head_.separator, ';', '\t', ','}) {
            CsvReader reader(text_, layout_.skipRows, separator);
            for (std::size_t i = 0; i < kHeadLines && reader.next(); ++i) {
                std::vector<std::string> fields;
                for (const auto field : reader.fields()) fields.push_back(latin1AsUtf8(field));
                std::size_t found = 0, asked = 0;
                for (const auto& wanted : wanted_) {
                    const auto* name = std::get_if<std::string>(&wanted);
                    asked += name != nullptr ? 1 : 0;
                    found += name != nullptr && std::ranges::find(fields, *name) != fields.end() ? 1 : 0;
                }
                if (found <= most) continue;
                most = found;
                line = reader.line();
                names = std::move(fields);
                separator_ = separator;
                if (found == asked) return settle(std::move(names), line);
            }
        }
        return settle(std::move(names), line);
    }

    Result<void> settle(std::vector<std::string> names, std::size_t line) {
        while (!names.empty() && names.back().empty()) names.pop_back();
        for (const auto& wanted : wanted_) {
            const auto index = indexIn(names, wanted, line);
            if (!index) return failure(index);
            indices_.push_back(*index);
        }
        width_ = names.size();
        headed_ = true;
        skip_ = line;
        // The header has a single column and no separator, so the commas below it are decimal commas.
        if (width_ == 1 && lineAt(line).find(separator_) == std::string_view::npos) separator_ = ';';
        return {};
    }

    Result<std::size_t> indexIn(const std::vector<std::string>& names, const ColumnChoice& wanted,
                                std::size_t line) const {
        if (const auto* number = std::get_if<std::size_t>(&wanted)) {
            if (*number <= names.size()) return *number - 1;
            return refuse(line, "no column {}; the header names {}", *number, names.size());
        }
        const auto& name = std::get<std::string>(wanted);
        const auto found = std::ranges::find(names, name);
        if (found == names.end()) {
            if (names.empty()) {
                return refuse(line,
                              "no line names column \"{}\": the file begins with numbers; columns are then called by "
                              "their numbers from 1, and \"rate_hz\" stands in place of \"time_column\" where none of "
                              "them is the time",
                              name);
            }
            return refuse(line, "no column \"{}\" in the header, which names {}", name, joined(names));
        }
        if (std::find(found + 1, names.end(), name) != names.end())
            return refuse(line, "{}", givenTwice("column \"{}\"", name));
        return static_cast<std::size_t>(found - names.begin());
    }

    /// Finds the first line in which every requested column holds a number, or is empty next to a number.
    Result<void> locateByNumber() {
        std::size_t last = 0;
        for (const auto& wanted : wanted_) {
            indices_.push_back(std::get<std::size_t>(wanted) - 1);
            last = std::max(last, indices_.back());
        }
        // If many lines precede the table, they may use another separator.
        if (const auto line = text_.find('\n', text_.size() / 2); line != std::string_view::npos)
            separator_ = readCsvHead(text_.substr(line + 1, kLookedAt), 0).separator;
        if (separator_ == ',' && last == 0) {  // a second column is requested, so the comma separates cells
            if (auto settled = settleCommas(); !settled) return settled;
        }
        CsvReader reader(text_, layout_.skipRows, separator_);
        std::size_t widest = 0, firstOfOthers = 0;
        for (std::size_t i = 0; i < kHeadLines && reader.next(); ++i) {
            const auto& fields = reader.fields();
            widest = std::max(widest, fields.size());
            if (fields.size() > last && holdsNumbers(fields)) {
                width_ = fields.size();
                skip_ = (firstOfOthers > 0 ? firstOfOthers : reader.line()) - 1;
                return {};
            }
            // Rows of numbers belong to the table and take up time, even if these columns are still empty.
            const bool ofOthers = fields.size() > last && isRowOfNumbers(fields) && allEmptyIn(fields);
            firstOfOthers = !ofOthers ? 0 : firstOfOthers > 0 ? firstOfOthers : reader.line();
        }
        if (widest <= last)
            return refuse(reader.line(), "no column {}: no row has more than {} cells", last + 1, widest);
        return refuse(reader.line(), "no row holds numbers in {}", wordsFor(layout_.columns.front()));
    }

    bool holdsNumbers(const std::vector<std::string_view>& fields) const {
        const auto all = [&](char point) {
            bool any = false;
            for (std::size_t i = 0; i < indices_.size(); ++i) {
                const auto field = fields[indices_[i]];
                const bool isNumber = fieldNumber(field, point).has_value();
                if (!isNumber && (!field.empty() || isTime(i))) return false;
                any = any || (isNumber && !isTime(i));
            }
            return any;
        };
        return all('.') || all(',');
    }

    bool allEmptyIn(const std::vector<std::string_view>& fields) const {
        return std::all_of(indices_.begin() + (layout_.timeColumn ? 1 : 0), indices_.end(),
                           [&](std::size_t i) { return fields[i].empty(); });
    }

    static bool isRowOfNumbers(const std::vector<std::string_view>& fields) {
        return !allEmpty(fields) && std::ranges::all_of(fields, [](std::string_view field) {
            return field.empty() || fieldNumber(field, '.') || fieldNumber(field, ',');
        });
    }

    /// Without a header and with one comma in each row, a decimal comma looks like a separator.
    Result<void> settleCommas() {
        if (layout_.decimal) {
            if (*layout_.decimal == ',') separator_ = ';';
            return {};
        }
        CsvReader reader(text_, layout_.skipRows, ',');
        std::size_t rows = 0;
        bool namesTwo = false;  // true: the line before the first row names two columns
        for (std::size_t i = 0; i < kHeadLines && reader.next(); ++i) {
            const auto& fields = reader.fields();
            const auto isNumber = [](std::string_view field) { return fieldNumber(field, '.').has_value(); };
            if (fields.size() == 2 && mayBeOneNumber(fields[0], fields[1])) {
                ++rows;
            } else if (fields.size() >= 2 && (rows > 0 || std::ranges::all_of(fields, isNumber))) {
                return {};
            } else if (rows == 0 && !isNumber(fields[0])) {
                namesTwo = fields.size() == 2;
            }
        }
        if (rows == 0 || namesTwo) return {};
        return refuse(head_.firstRow ? head_.firstRow->number : 1,
                      "the comma in each row may be a decimal comma or separate two columns; \"decimal\": \",\" or "
                      "\"decimal\": \".\" in the stream's entry says which");
    }

    std::string_view lineAt(std::size_t number) const {
        auto rest = text_;
        for (std::size_t i = 1; i < number; ++i) rest.remove_prefix(std::min(rest.find('\n'), rest.size() - 1) + 1);
        return rest.substr(0, rest.find('\n'));
    }

    /// Skips a line of units below the header if it agrees with the layout.
    Result<void> passUnits(CsvReader& reader) {
        if (!headed_ || !reader.next() || reader.fields().size() < width_) return {};
        bool any = false;
        for (const auto index : indices_) any = any || !reader.fields()[index].empty();
        if (!any) return {};
        for (std::size_t i = 0; i < indices_.size(); ++i) {
            const auto field = withoutBrackets(reader.fields()[indices_[i]]);
            if (field.empty()) continue;
            const auto spelled = latin1AsUtf8(field);
            std::optional<double> factor;
            if (isTime(i)) {
                if (const auto unit = recordedTimeUnit(spelled)) factor = unit->perSecond;
            } else {
                for (const auto& kind : kStreamKinds) {
                    if (const auto unit = recordedUnit(kind.value, spelled)) factor = unit->factor;
                }
            }
            if (!factor) return {};  // not a line of units but a row, or refused as a row later
            if (*factor != (isTime(i) ? layout_.timeDivisor : layout_.valueFactor)) {
                return refuse(reader.line(), "{} is in {} by the line below the header; recording.json says otherwise",
                              wordsFor(wanted_[i]), excerpt(field));
            }
        }
        skip_ = reader.line();
        return {};
    }

    /// Finds the decimal character from the first row with a point or a comma in its numbers.
    void findDecimal() {
        if (layout_.decimal) {
            point_ = *layout_.decimal;
            return;
        }
        CsvReader reader(text_, skip_, separator_);
        while (reader.next()) {
            bool pointed = true, comma = true, told = false;
            for (const auto index : indices_) {
                if (index >= reader.fields().size() || reader.fields()[index].empty()) continue;
                const auto field = reader.fields()[index];
                told = told || field.find_first_of(".,") != std::string_view::npos;
                pointed = pointed && fieldNumber(field, '.');
                comma = comma && fieldNumber(field, ',');
            }
            if (!told) continue;
            point_ = comma && !pointed ? ',' : '.';
            return;
        }
    }

    Result<void> take(const std::vector<std::string_view>& fields, std::size_t line) {
        if (fields.size() < width_) {
            return refuse(line, "the row has {} cells where the {} {}: the file is cut short or damaged here",
                          fields.size(), headed_ ? "header names" : "first has", width_);
        }
        if (!allEmpty(fields, width_)) {
            return refuse(line, "the row has {} cells where the {} {}", fields.size(),
                          headed_ ? "header names" : "first has", width_);
        }
        const bool missing = allEmptyIn(fields);
        double t_s = static_cast<double>(rows_++) / layout_.rate_hz;
        if (layout_.timeColumn) {
            const auto cell = fields[indices_.front()];
            if (missing && cell.empty()) return {};  // a row of another stream that has its own times
            const auto time = number(cell, 0, line);
            if (!time) return failure(time);
            if (!std::isfinite(*time)) {
                return refuse(line, "{}: time \"{}\" is not a finite number", wordsFor(wanted_.front()), excerpt(cell));
            }
            t_s = *time / layout_.timeDivisor;
        }
        for (std::size_t i = layout_.timeColumn ? 1 : 0; i < indices_.size(); ++i) {
            const auto cell = fields[indices_[i]];
            const Result<double> value =
                cell.empty() ? Result<double>(std::numeric_limits<double>::quiet_NaN()) : number(cell, i, line);
            if (!value) return failure(value);
            out_.values.push_back(*value * layout_.valueFactor);
        }
        out_.t_s.push_back(t_s);
        empty_.push_back(missing);
        return {};
    }

    Result<double> number(std::string_view cell, std::size_t wanted, std::size_t line) const {
        if (const auto value = fieldNumber(cell, point_)) return *value;
        return refuse(line, "{}: {} where a number was expected", wordsFor(wanted_[wanted]),
                      cell.empty() ? std::string("an empty cell") : "\"" + excerpt(cell) + "\"");
    }

    /// Keeps a row without a value only if it fills a gap between other rows at their rate.
    void dropRowsOfOthers() {
        if (std::ranges::find(empty_, true) == empty_.end()) return;
        const std::size_t channels = layout_.columns.size();
        std::vector<double> held;
        for (std::size_t i = 0; i < empty_.size(); ++i) {
            if (!empty_[i]) held.push_back(out_.t_s[i]);
        }
        const bool alone = indices_.size() == width_;  // no other stream has a column here
        const double rate_hz = roughRate_hz(held);
        SampleBlock kept;
        const auto keep = [&](std::size_t i) {
            kept.t_s.push_back(out_.t_s[i]);
            const auto row = out_.values.begin() + static_cast<std::ptrdiff_t>(i * channels);
            kept.values.insert(kept.values.end(), row, row + static_cast<std::ptrdiff_t>(channels));
        };
        for (std::size_t i = 0; i < empty_.size(); ++i) {
            if (!empty_[i]) {
                keep(i);
                continue;
            }
            const std::size_t from = i;
            while (i < empty_.size() && empty_[i]) ++i;
            if (i == empty_.size()) break;
            // Before the first value, the time of the previous sample is unknown; after a value, it was one step ago.
            const double begun = from == 0 ? out_.t_s[0] - (rate_hz > 0 ? 1 / rate_hz : 0) : out_.t_s[from - 1];
            const double due = std::round((out_.t_s[i] - begun) * rate_hz) - 1;
            for (std::size_t j = from; j < i && (alone || static_cast<double>(i - from) <= due); ++j) keep(j);
            --i;
        }
        out_ = std::move(kept);
    }

    [[nodiscard]] bool isTime(std::size_t wanted) const noexcept { return wanted == 0 && layout_.timeColumn; }

    const std::string_view text_;
    const std::string_view name_;
    const TableLayout& layout_;
    CsvHead head_;
    std::vector<ColumnChoice> wanted_;  // the time first, if there is one
    std::vector<std::size_t> indices_;  // position of each wanted cell in a row
    std::size_t width_ = 0;
    std::size_t skip_ = 0;  // number of lines before the rows
    bool headed_ = false;
    char separator_;
    char point_ = '.';
    std::size_t rows_ = 0;
    SampleBlock out_;
    std::vector<bool> empty_;  // which of the stream's samples have no value
};

}  // namespace

Result<SampleBlock> readTable(std::string_view text, std::string_view name, const TableLayout& layout) {
    constexpr std::string_view kByteOrderMark = "\xEF\xBB\xBF";
    if (text.starts_with(kByteOrderMark)) text.remove_prefix(kByteOrderMark.size());
    const bool wide = utf16OrderOf(text).has_value();
    const auto converted = wide ? asUtf8(text) : std::string();
    return TableReader(wide ? std::string_view(converted) : text, name, layout).read();
}

}  // namespace tacto
