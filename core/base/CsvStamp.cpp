#include "core/base/CsvStamp.h"

#include <chrono>

namespace tacto {

namespace {

class StampReader {
public:
    StampReader(const char* text, const char* end) noexcept : at_(text), end_(end) {}

    [[nodiscard]] bool take(char c) noexcept {
        if (at_ == end_ || *at_ != c) return false;
        ++at_;
        return true;
    }
    /// Reads a number of exactly `digits` digits.
    [[nodiscard]] std::optional<int> digits(int digits) noexcept {
        int value = 0;
        for (int i = 0; i < digits; ++i, ++at_) {
            if (at_ == end_ || *at_ < '0' || *at_ > '9') return std::nullopt;
            value = 10 * value + (*at_ - '0');
        }
        return value;
    }
    /// Reads the digits after a decimal point.
    [[nodiscard]] double fraction() noexcept {
        double value = 0;
        double scale = 1;
        for (; at_ != end_ && *at_ >= '0' && *at_ <= '9'; ++at_) {
            value = 10 * value + (*at_ - '0');
            scale *= 10;
        }
        return value / scale;
    }
    [[nodiscard]] const char* at() const noexcept { return at_; }

private:
    const char* at_;
    const char* end_;
};

/// Reads "10:00:00.5" or "100000.5"; accepts 60 s for a leap second.
bool takeTimeOfDay(StampReader& reader, bool colons, char point, CsvStamp& stamp) noexcept {
    const auto hours = reader.digits(2);
    if (!hours || *hours > 23 || (colons && !reader.take(':'))) return false;
    const auto minutes = reader.digits(2);
    if (!minutes || *minutes > 59) return false;
    std::optional<int> seconds = 0;
    if (!colons || reader.take(':')) seconds = reader.digits(2);
    if (!seconds || *seconds > 60) return false;
    stamp.seconds += *hours * 3600 + *minutes * 60 + *seconds;
    if (reader.take(point)) stamp.fraction = reader.fraction();
    return true;
}

bool takeZone(StampReader& reader, CsvStamp& stamp) noexcept {
    if (reader.take('Z') || reader.take('z')) return true;
    const bool east = reader.take('+');
    if (!east && !reader.take('-')) return true;  // no zone
    const auto hours = reader.digits(2);
    if (!hours || *hours > 23) return false;
    const bool colon = reader.take(':');
    auto rest = reader;
    auto minutes = rest.digits(2);
    if (minutes) reader = rest;
    if ((colon && !minutes) || minutes.value_or(0) > 59) return false;
    const int offset = *hours * 3600 + minutes.value_or(0) * 60;
    stamp.seconds += east ? -offset : offset;
    return true;
}

}  // namespace

const char* takeStamp(const char* text, const char* end, char point, CsvStamp& stamp) noexcept {
    stamp = {};
    if (end - text < 5) return nullptr;
    if (text[2] == ':') {
        StampReader reader(text, end);
        return takeTimeOfDay(reader, true, point, stamp) ? reader.at() : nullptr;
    }
    StampReader reader(text, end);
    const auto year = reader.digits(4);
    const bool dashes = reader.take('-');
    const auto month = year ? reader.digits(2) : std::nullopt;
    if (!month || (dashes && !reader.take('-'))) return nullptr;
    const auto day = reader.digits(2);
    if (!day || !(reader.take('T') || reader.take('t') || (dashes && reader.take(' ')))) return nullptr;
    const std::chrono::year_month_day date{std::chrono::year(*year), std::chrono::month(static_cast<unsigned>(*month)),
                                           std::chrono::day(static_cast<unsigned>(*day))};
    if (!date.ok()) return nullptr;
    stamp.seconds = std::int64_t{86400} * std::chrono::sys_days(date).time_since_epoch().count();
    if (!takeTimeOfDay(reader, dashes, point, stamp) || !takeZone(reader, stamp)) return nullptr;
    return reader.at();
}

std::optional<CsvStamp> fieldStamp(std::string_view field, char point) noexcept {
    CsvStamp stamp;
    const char* const end = field.data() + field.size();
    return takeStamp(field.data(), end, point, stamp) == end ? std::optional(stamp) : std::nullopt;
}

}  // namespace tacto
