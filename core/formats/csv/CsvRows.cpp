#include "core/formats/csv/CsvRows.h"

#include <cmath>
#include <cstring>
#include <limits>

#include "core/base/Csv.h"
#include "core/base/CsvHead.h"
#include "core/base/CsvNumber.h"

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
        const std::size_t row = batch_.rows;
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

const char* CsvRows::takePlainRow(const char* text, const char* end, std::size_t row) {
    const char separator = separator_;
    const char point = point_;
    for (Use* use = uses_.data(); use != uses_.data() + uses_.size(); ++use) {
        if (use != uses_.data() && *text++ != separator) return nullptr;
        text = overBlanks(text, separator);
        if (use->ignored) {
            while (*text != separator && *text != '\n' && *text != '"') ++text;
            if (*text == '"') return nullptr;
        } else {
            text = takeNumber(text, end, point, use->values[row]);
            if (text == nullptr) return nullptr;
            text = overBlanks(text, separator);
        }
    }
    while (*text == separator) text = overBlanks(text + 1, separator);
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
        uses_[c].values[row] = *value;
    }
    return {};
}

}  // namespace tacto
