#include "core/formats/CsvRows.h"

#include <cmath>
#include <cstring>
#include <fast_float/fast_float.h>
#include <limits>

#include "core/base/Csv.h"
#include "core/formats/FieldNumber.h"

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

/// A field that takeNumber() reads to its end: one with an exponent, or a plus.
[[gnu::noinline]] bool takeLongField(const char* begin, const char* end, char point, double& into) {
    double value = 0;
    if (takeNumber(begin, point, value) != end) return false;
    into = value;
    return true;
}

[[gnu::always_inline]] inline bool takeField(const char* begin, const char* end, char point, double& into) {
    double value = 0;
    if (!fieldNumber(begin, end, point, value)) return takeLongField(begin, end, point, into);
    into = value;
    return true;
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
        uses_[layout.timeColumn].ignored = false;
    }
    batch_.channels.assign(layout.channels.size(), std::vector<float>(RowBatch::kRows));
    batch_.lines.resize(RowBatch::kRows);
    for (std::size_t c = 0; c < layout.channels.size(); ++c) {
        const auto& channel = layout.channels[c];
        auto& use = uses_[channel.number - 1];
        use.ignored = false;
        use.channel = c;
        use.factor = channel.factor;
        constexpr double kOrdinary = 1e15;
        ordinaryFactors_ = ordinaryFactors_ && std::abs(channel.factor) < kOrdinary;
    }
    for (auto& use : uses_) {
        use.values.resize(RowBatch::kRows);
        into_.push_back(use.values.data());
        anyIgnored_ = anyIgnored_ || use.ignored;
    }
}

double CsvRows::bytesPerRow() const noexcept {
    return rows_ == 0 ? 0 : static_cast<double>(bytes_) / static_cast<double>(rows_);
}

Result<const RowBatch*> CsvRows::next(const ReadWatch& watch) {
    batch_.rows = 0;
    batch_.complete = ordinaryFactors_;
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
    deliver();
    return &batch_;
}

Result<void> CsvRows::takeRows() {
    const char* text = text_.data();
    const char* const end = text + text_.size();
    while (text != end && batch_.rows < RowBatch::kRows) {
        text = takeShortRows(text, end);
        const std::size_t row = batch_.rows;
        if (text == end || row == RowBatch::kRows) break;
        batch_.complete = false;
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
    if (anyIgnored_) return text;
    const char separator = separator_;
    const char point = point_;
    const std::size_t others = uses_.size() - 1;  // columns before the last
    double* const* const into = into_.data();
    for (;;) {
        ends_.look(text, end);
        const char* const base = text;
        std::size_t next = 0;  // end of the field at hand
        std::size_t row = batch_.rows;
        bool whole = true;
        while (next + others < ends_.count() && row < RowBatch::kRows) {
            const char* begin = text;
            for (std::size_t c = 0; c < others && whole; ++c) {
                const char* const fieldEnd = base + ends_[next + c];
                whole = *fieldEnd == separator && takeField(begin, fieldEnd, point, into[c][row]);
                begin = fieldEnd + 1;
            }
            // The last one ends with the line, for which two characters may stand.
            const char* const lineEnd = base + ends_[next + others];
            const char* const fieldEnd = lineEnd - static_cast<int>(lineEnd > begin && lineEnd[-1] == '\r');
            if (!whole || *lineEnd != '\n' || !takeField(begin, fieldEnd, point, into[others][row])) {
                whole = false;
                break;
            }
            batch_.lines[row++] = line_++;
            next += others + 1;
            text = lineEnd + 1;
        }
        batch_.rows = row;
        if (!whole || text == base || text == end || row == RowBatch::kRows) return text;
    }
}

const char* CsvRows::takePlainRow(const char* text, const char* end, std::size_t row) {
    const std::size_t width = uses_.size();
    for (std::size_t c = 0; c < width; ++c) {
        const Use& use = uses_[c];
        text = overBlanks(text, separator_);
        if (use.ignored) {
            while (*text != separator_ && *text != '\n' && *text != '"') ++text;
            if (*text == '"') return nullptr;
        } else {
            double value = 0;
            text = takeAnyNumber(text, end, point_, value);
            if (text == nullptr) return nullptr;
            into_[c][row] = value;
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

void CsvRows::deliver() {
    for (const auto& use : uses_) {
        if (use.ignored) continue;
        const double* const from = use.values.data();
        if (use.channel == Use::kTime) {
            std::copy_n(from, batch_.rows, batch_.times.begin());
            continue;
        }
        float* const into = batch_.channels[use.channel].data();
        for (std::size_t i = 0; i < batch_.rows; ++i) into[i] = static_cast<float>(from[i] * use.factor);
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
        if (uses_[c].ignored) continue;
        const auto value =
            fields_[c].empty() ? std::numeric_limits<double>::quiet_NaN() : fieldNumber(fields_[c], point_);
        if (!value) {
            return fail(ErrorCode::ParseError, "{}:{}: '{}' in column '{}'; a number was expected", blocks_.name(),
                        line_, fields_[c].substr(0, 40), layout_.names[c]);
        }
        sawInfinite_ = sawInfinite_ || std::isinf(*value);
        into_[c][row] = *value;
    }
    return {};
}

}  // namespace tacto
