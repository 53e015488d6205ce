#include "core/formats/CsvRows.h"

#include <cmath>
#include <cstring>
#include <fast_float/fast_float.h>
#include <limits>

#include "core/formats/NumberText.h"

namespace tacto {

namespace {

const char* overBlanks(const char* text, char separator) {
    while (*text == ' ' || (*text == '\t' && separator != '\t')) ++text;
    return text;
}

/// takeNumber(), and the library's way for numbers of many digits, "nan" and "inf".
const char* takeAnyNumber(const char* text, const char* end, char point, double& value) {
    if (const auto* behind = takeNumber(text, point, value)) return behind;
    if (*text == '+') ++text;
    const auto [behind, error] = fast_float::from_chars_advanced(
        text, end, value, fast_float::parse_options(fast_float::chars_format::general, point));
    return error == std::errc() ? behind : nullptr;
}

}  // namespace

CsvRows::CsvRows(const CsvLayout& layout, char separator, char point, TextBlocks& blocks)
    : layout_(layout),
      separator_(separator),
      point_(point),
      blocks_(blocks),
      uses_(layout.width),
      ends_(separator),
      line_(layout.dataLine),
      skip_(layout.dataOffset) {
    if (layout.times != RowTimes::Counted) {
        batch_.times.resize(RowBatch::kRows);
        uses_[layout.timeColumn].kind = Use::Kind::Time;
    }
    batch_.channels.assign(layout.channels.size(), std::vector<float>(RowBatch::kRows));
    batch_.lines.resize(RowBatch::kRows);
    for (std::size_t c = 0; c < layout.channels.size(); ++c) {
        const auto& channel = layout.channels[c];
        uses_[channel.number - 1] = {Use::Kind::Channel, batch_.channels[c].data(), channel.factor};
    }
}

double CsvRows::bytesPerRow() const noexcept {
    return rows_ == 0 ? 0 : static_cast<double>(bytes_) / static_cast<double>(rows_);
}

Result<const RowBatch*> CsvRows::next(const ReadWatch& watch) {
    batch_.rows = 0;
    while (batch_.rows < RowBatch::kRows) {
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
    return &batch_;
}

Result<void> CsvRows::takeRows() {
    const char* text = text_.data();
    const char* const end = text + text_.size();
    while (text != end && batch_.rows < RowBatch::kRows) {
        text = takeShortRows(text, end);
        const std::size_t row = batch_.rows;
        if (text == end || row == RowBatch::kRows) break;
        if (const char* const next = takePlainRow(text, end, row)) {
            batch_.lines[row] = line_++;
            ++batch_.rows;
            text = next;
            continue;
        }
        const auto length = static_cast<std::size_t>(
            static_cast<const char*>(std::memchr(text, '\n', static_cast<std::size_t>(end - text))) - text);
        const std::string_view line(text, length);
        if (!isBlankOrComment(line)) {
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

const char* CsvRows::takeShortRows(const char* text, const char* end) {
    const std::uint64_t points = eightTimes(point_);
    const std::size_t width = uses_.size();
    const Use* const uses = uses_.data();
    for (;;) {
        ends_.look(text, end);
        const char* const base = text;
        std::size_t next = 0;  // end of the field at hand
        while (next + width <= ends_.count() && batch_.rows < RowBatch::kRows) {
            const std::size_t row = batch_.rows;
            const char* begin = text;
            for (std::size_t c = 0; c < width; ++c) {
                const char* fieldEnd = base + ends_[next + c];
                const bool last = c + 1 == width;
                // A row that ends before its last field, or a field too much; an end of line may be two characters.
                if (last ? *fieldEnd != '\n' : *fieldEnd == '\n') return text;
                const char* const following = fieldEnd + 1;
                if (last) fieldEnd -= static_cast<int>(fieldEnd[-1] == '\r' && fieldEnd > begin);
                const Use& use = uses[c];
                if (use.kind == Use::Kind::Ignored) return text;
                double value = 0;
                if (!fieldNumber(begin, fieldEnd, points, value)) {
                    // The same row may yet be numbers with exponents.
                    if (takeNumber(begin, point_, value) != fieldEnd) return text;
                }
                if (use.kind == Use::Kind::Time) {
                    batch_.times[row] = value;
                } else {
                    use.into[row] = static_cast<float>(value * use.factor);
                }
                begin = following;
            }
            batch_.lines[row] = line_++;
            ++batch_.rows;
            next += width;
            text = begin;
        }
        if (text == base || text == end || batch_.rows == RowBatch::kRows) return text;
    }
}

const char* CsvRows::takePlainRow(const char* text, const char* end, std::size_t row) {
    const std::size_t width = uses_.size();
    for (std::size_t c = 0; c < width; ++c) {
        const Use& use = uses_[c];
        text = overBlanks(text, separator_);
        if (use.kind == Use::Kind::Ignored) {
            while (*text != separator_ && *text != '\n' && *text != '"') ++text;
            if (*text == '"') return nullptr;
        } else {
            double value = 0;
            text = takeAnyNumber(text, end, point_, value);
            if (text == nullptr) return nullptr;
            if (use.kind == Use::Kind::Time) {
                batch_.times[row] = value;
            } else {
                use.into[row] = static_cast<float>(value * use.factor);
            }
            text = overBlanks(text, separator_);
        }
        if (c + 1 == width) break;
        if (*text != separator_) return nullptr;
        ++text;
    }
    while (*text == separator_) text = overBlanks(text + 1, separator_);
    if (*text == '\r') ++text;
    return *text == '\n' ? text + 1 : nullptr;
}

void CsvRows::store(std::size_t column, std::size_t row, double value) {
    const Use& use = uses_[column];
    if (use.kind == Use::Kind::Time) batch_.times[row] = value;
    if (use.kind == Use::Kind::Channel) {
        sawInfinite_ = sawInfinite_ || std::isinf(value);
        use.into[row] = static_cast<float>(value * use.factor);
    }
}

Result<void> CsvRows::takeFields(std::string_view line, std::size_t row) {
    cutLine(line, separator_, fields_);
    const std::size_t width = uses_.size();
    bool surplus = false;
    for (std::size_t i = width; i < fields_.size(); ++i) surplus = surplus || !fields_[i].empty();
    if (fields_.size() < width || surplus) {
        return fail(ErrorCode::ParseError, "{}:{}: {} fields; {} were expected, as in the header", blocks_.name(),
                    line_, fields_.size(), width);
    }
    for (std::size_t c = 0; c < width; ++c) {
        if (uses_[c].kind == Use::Kind::Ignored) continue;
        const auto value =
            fields_[c].empty() ? std::numeric_limits<double>::quiet_NaN() : fieldNumber(fields_[c], point_);
        if (!value) {
            return fail(ErrorCode::ParseError, "{}:{}: '{}' in column '{}'; a number was expected", blocks_.name(),
                        line_, fields_[c].substr(0, 40), layout_.names[c]);
        }
        store(c, row, *value);
    }
    return {};
}

}  // namespace tacto
