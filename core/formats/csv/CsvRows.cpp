#include "core/formats/csv/CsvRows.h"

#include <algorithm>
#include <cmath>
#include <cstring>
#include <limits>

#include "core/base/Csv.h"
#include "core/base/CsvHead.h"
#include "core/base/CsvStamp.h"
#include "core/base/Utf16.h"

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

}  // namespace tacto
