#include "core/acquisition/RecordingTable.h"

#include <algorithm>
#include <cmath>

#include "core/base/Csv.h"
#include "core/base/GivenOnce.h"
#include "core/base/Text.h"

namespace tacto {

namespace {

constexpr std::size_t kLongestQuote = 40;  // of the file's own text, in a message

std::string excerpt(std::string_view cell) {
    std::string out(cell.substr(0, kLongestQuote));
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

/// The header's names without the empty ones that trailing commas leave.
Result<std::vector<std::string>> readHeader(CsvReader& reader, std::string_view name, const TableLayout& layout) {
    if (!reader.next()) {
        return fail(ErrorCode::ParseError, "{}:1: the file is empty, a header line naming column \"{}\" was expected",
                    name, layout.timeColumn);
    }
    std::vector<std::string> names(reader.fields().begin(), reader.fields().end());
    while (!names.empty() && names.back().empty()) names.pop_back();
    return names;
}

Result<std::size_t> findColumn(const std::vector<std::string>& names, const std::string& wanted, std::string_view file,
                               std::size_t line) {
    const auto found = std::find(names.begin(), names.end(), wanted);
    if (found == names.end()) {
        return fail(ErrorCode::ParseError, "{}:{}: no column \"{}\" in the header, which names {}", file, line, wanted,
                    joined(names));
    }
    if (std::find(found + 1, names.end(), wanted) != names.end()) {
        return fail(ErrorCode::ParseError, "{}:{}: {}", file, line, givenTwice("column \"{}\"", wanted));
    }
    return static_cast<std::size_t>(found - names.begin());
}

bool allEmpty(const std::vector<std::string_view>& fields, std::size_t from = 0) {
    return std::all_of(fields.begin() + static_cast<std::ptrdiff_t>(std::min(from, fields.size())), fields.end(),
                       [](std::string_view field) { return field.empty(); });
}

/// One row's samples appended to `out`; false when every wanted value is empty.
class RowReader {
public:
    RowReader(std::string_view file, const TableLayout& layout, const std::vector<std::string>& names,
              std::size_t timeIndex, std::vector<std::size_t> indices)
        : file_(file), layout_(layout), width_(names.size()), timeIndex_(timeIndex), indices_(std::move(indices)) {}

    Result<bool> append(const std::vector<std::string_view>& fields, std::size_t line, SampleBlock& out) const {
        if (fields.size() < width_) {
            return fail(ErrorCode::ParseError,
                        "{}:{}: the row has {} cells where the header names {}: the file is cut short or damaged here",
                        file_, line, fields.size(), width_);
        }
        if (!allEmpty(fields, width_)) {
            return fail(ErrorCode::ParseError, "{}:{}: the row has {} cells where the header names {}", file_, line,
                        fields.size(), width_);
        }
        const auto time = number(fields[timeIndex_], layout_.timeColumn, line);
        if (!time) return failure(time);
        if (!std::isfinite(*time)) {
            return fail(ErrorCode::ParseError, "{}:{}: column \"{}\": time \"{}\" is not a finite number", file_, line,
                        layout_.timeColumn, excerpt(fields[timeIndex_]));
        }
        if (std::all_of(indices_.begin(), indices_.end(), [&](std::size_t i) { return fields[i].empty(); })) {
            return false;
        }
        for (std::size_t c = 0; c < indices_.size(); ++c) {
            const auto value = number(fields[indices_[c]], layout_.columns[c], line);
            if (!value) return failure(value);
            out.values.push_back(*value * layout_.valueFactor);
        }
        out.t_s.push_back(*time / layout_.timeDivisor);
        return true;
    }

private:
    Result<double> number(std::string_view cell, const std::string& column, std::size_t line) const {
        if (const auto value = parseNumber(cell)) return *value;
        return fail(ErrorCode::ParseError, "{}:{}: column \"{}\": {} where a number was expected", file_, line, column,
                    cell.empty() ? std::string("an empty cell") : "\"" + excerpt(cell) + "\"");
    }

    std::string_view file_;
    const TableLayout& layout_;
    std::size_t width_;
    std::size_t timeIndex_;
    std::vector<std::size_t> indices_;
};

}  // namespace

Result<SampleBlock> readTable(std::string_view text, std::string_view name, const TableLayout& layout) {
    CsvReader reader(text);
    const auto names = readHeader(reader, name, layout);
    if (!names) return failure(names);
    const auto timeIndex = findColumn(*names, layout.timeColumn, name, reader.line());
    if (!timeIndex) return failure(timeIndex);
    std::vector<std::size_t> indices;
    for (const auto& column : layout.columns) {
        const auto index = findColumn(*names, column, name, reader.line());
        if (!index) return failure(index);
        indices.push_back(*index);
    }

    const RowReader row(name, layout, *names, *timeIndex, std::move(indices));
    SampleBlock out;
    std::size_t withoutValues = 0;  // line of a row that names a time and nothing else
    while (reader.next()) {
        if (allEmpty(reader.fields())) continue;
        if (withoutValues != 0) {
            return fail(ErrorCode::ParseError, "{}:{}: the row holds a time and no value; numbers were expected", name,
                        withoutValues);
        }
        const auto taken = row.append(reader.fields(), reader.line(), out);
        if (!taken) return failure(taken);
        if (!*taken) withoutValues = reader.line();
    }
    if (out.samples() < 2) {
        return fail(ErrorCode::ParseError, "{}:{}: the file ends after {} data rows; at least 2 were expected", name,
                    reader.line(), out.samples());
    }
    return out;
}

}  // namespace tacto
