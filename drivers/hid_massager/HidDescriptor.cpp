#include "drivers/hid_massager/HidDescriptor.h"

#include <algorithm>

#include "core/base/Words.h"

namespace tacto::hid {

namespace {

constexpr std::size_t kMaxPushes = 16;
constexpr std::size_t kMaxUsages = 1024;  // limit of usages that wait for one main item
constexpr std::size_t kMaxDepth = 32;

// HID 1.11 section 6.2.2: an item's tag and type, without its size bits.
enum Item : std::uint8_t {
    kInput = 0x80,
    kOutput = 0x90,
    kFeature = 0xB0,
    kCollection = 0xA0,
    kEndCollection = 0xC0,
    kUsagePage = 0x04,
    kLogicalMin = 0x14,
    kLogicalMax = 0x24,
    kReportSize = 0x74,
    kReportId = 0x84,
    kReportCount = 0x94,
    kPush = 0xA4,
    kPop = 0xB4,
    kUsage = 0x08,
    kUsageMin = 0x18,
    kUsageMax = 0x28,
};
constexpr std::uint8_t kLongItem = 0xFE;
constexpr std::uint32_t kConstant = 1;  // bit of a main item's data
constexpr std::uint32_t kVariable = 2;

struct Globals {
    std::uint16_t page = 0;
    std::int64_t min = 0;
    std::uint32_t maxBits = 0;  // maximum as written: signed only if min is negative
    std::int64_t maxSigned = 0;
    std::uint32_t size = 0;
    std::uint32_t count = 0;
    std::uint8_t report = 0;
};

class Parser {
public:
    explicit Parser(std::span<const std::uint8_t> bytes) : bytes_(bytes) {}

    Result<HidDescriptor> run() {
        if (bytes_.empty() || bytes_.size() > kMaxDescriptor) {
            return fail(ErrorCode::ParseError, "HID report descriptor: {} bytes; 1 to {} were expected", bytes_.size(),
                        kMaxDescriptor);
        }
        while (at_ < bytes_.size()) {
            if (auto read = item(); !read) return failure(read);
        }
        if (open_ != kNoCollection) return wrong("ends inside a collection");
        return std::move(out_);
    }

private:
    template <class... Args>
    tl::unexpected<Error> wrong(fmt::format_string<Args...> text, Args&&... args) const {
        return fail(ErrorCode::ParseError, "HID report descriptor: byte {}: {}", item_,
                    fmt::format(text, std::forward<Args>(args)...));
    }

    Result<void> item() {
        item_ = at_;
        const std::uint8_t prefix = bytes_[at_++];
        if (prefix == kLongItem) {
            if (bytes_.size() - at_ < 2) return wrong("a long item is cut off");
            const std::size_t length = std::size_t{bytes_[at_]} + 2;
            if (bytes_.size() - at_ < length) return wrong("a long item is cut off");
            at_ += length;  // skips long items: the standard defines none
            return {};
        }
        const std::size_t size = (prefix & 3) == 3 ? 4 : prefix & 3;
        if (bytes_.size() - at_ < size) return wrong("an item is cut off");
        std::uint32_t value = 0;
        for (std::size_t i = 0; i < size; ++i) value |= std::uint32_t{bytes_[at_ + i]} << (8 * i);
        at_ += size;
        return take(prefix & 0xFC, value, size);
    }

    static std::int64_t signedOf(std::uint32_t value, std::size_t size) noexcept {
        if (size == 1) return static_cast<std::int8_t>(value);
        if (size == 2) return static_cast<std::int16_t>(value);
        return static_cast<std::int32_t>(value);
    }

    Result<void> take(std::uint8_t tag, std::uint32_t value, std::size_t size) {
        switch (tag) {
            case kInput:
                return main(ReportKind::Input, value);
            case kOutput:
                return main(ReportKind::Output, value);
            case kFeature:
                return main(ReportKind::Feature, value);
            case kCollection:
                return openCollection(value);
            case kEndCollection:
                if (open_ == kNoCollection) return wrong("ends a collection that is not open");
                open_ = out_.collections[open_].parent;
                --depth_;
                usages_.clear();
                return {};
            case kUsagePage:
                if (value > 0xFFFF) return wrong("usage page {:#x}; at most 0xffff was expected", value);
                now_.page = static_cast<std::uint16_t>(value);
                return {};
            case kLogicalMin:
                now_.min = size == 0 ? 0 : signedOf(value, size);
                return {};
            case kLogicalMax:
                now_.maxBits = value;
                now_.maxSigned = size == 0 ? 0 : signedOf(value, size);
                return {};
            case kReportSize:
                now_.size = value;
                return {};
            case kReportCount:
                now_.count = value;
                return {};
            case kReportId:
                if (value < 1 || value > 255) return wrong("report number {}; 1 to 255 were expected", value);
                if (unnumbered_) return wrong("a report number after reports without one");
                now_.report = static_cast<std::uint8_t>(value);
                return {};
            case kPush:
                if (pushed_.size() == kMaxPushes) return wrong("more than {} pushes", kMaxPushes);
                pushed_.push_back(now_);
                return {};
            case kPop:
                if (pushed_.empty()) return wrong("a pop without a push");
                now_ = pushed_.back();
                pushed_.pop_back();
                return {};
            case kUsage:
                return addUsages(full(value, size), full(value, size));
            case kUsageMin:
                usageMin_ = full(value, size);
                return {};
            case kUsageMax: {
                if (!usageMin_) return wrong("a usage maximum without a minimum");
                const Usage first = *usageMin_;
                usageMin_.reset();
                return addUsages(first, full(value, size));
            }
            default:
                return {};  // units, strings, designators and reserved items change no position
        }
    }

    [[nodiscard]] Usage full(std::uint32_t value, std::size_t size) const noexcept {
        return size == 4 ? value : usageOf(now_.page, static_cast<std::uint16_t>(value));
    }

    Result<void> addUsages(Usage first, Usage last) {
        if (last < first || last - first >= kMaxUsages - usages_.size()) {
            return wrong("usages {:#x} to {:#x}; at most {} in order were expected", first, last, kMaxUsages);
        }
        for (Usage usage = first;; ++usage) {
            usages_.push_back(usage);
            if (usage == last) return {};
        }
    }

    Result<void> openCollection(std::uint32_t type) {
        if (out_.collections.size() == kMaxCollections || depth_ == kMaxDepth) {
            return wrong("more than {} collections, or {} inside each other", kMaxCollections, kMaxDepth);
        }
        out_.collections.push_back({usages_.empty() ? 0 : usages_.front(), static_cast<std::uint8_t>(type), open_});
        open_ = static_cast<std::uint16_t>(out_.collections.size() - 1);
        ++depth_;
        usages_.clear();
        return {};
    }

    HidDescriptor::Report& reportOf(ReportKind kind) {
        for (auto& report : out_.reports) {
            if (report.kind == kind && report.number == now_.report) return report;
        }
        return out_.reports.emplace_back(HidDescriptor::Report{kind, now_.report, 0});
    }

    Result<void> main(ReportKind kind, std::uint32_t flags) {
        if (now_.report == 0) unnumbered_ = true;
        auto& report = reportOf(kind);
        const std::uint64_t wanted = std::uint64_t{now_.size} * now_.count;
        if (wanted > kMaxReportBits - report.bits) {
            return wrong("{} controls of {} bits make {} report {} longer than {} bytes", now_.count, now_.size,
                         nameOf(kind), now_.report, kMaxReportBits / 8);
        }
        const std::uint32_t first = report.bits;
        report.bits += static_cast<std::uint32_t>(wanted);
        if ((flags & kConstant) == 0 && wanted > 0) {
            if (auto added = addFields(kind, flags, first); !added) return added;
        }
        usages_.clear();
        usageMin_.reset();
        return {};
    }

    Result<void> addFields(ReportKind kind, std::uint32_t flags, std::uint32_t first) {
        if (now_.size > 32) return {};  // a buffer (contact images, descriptors), not one of our controls
        if (now_.count > kMaxFields - out_.fields.size()) return wrong("more than {} controls", kMaxFields);
        HidField field;
        field.kind = kind;
        field.report = now_.report;
        field.bits = static_cast<std::uint8_t>(now_.size);
        field.min = now_.min;
        field.max = now_.min < 0 ? now_.maxSigned : std::int64_t{now_.maxBits};
        if (field.max < field.min) return wrong("logical range {} to {} is empty", field.min, field.max);
        field.array = (flags & kVariable) == 0;
        field.collection = open_;
        for (std::uint32_t i = 0; i < now_.count; ++i) {
            field.bit = 8 + first + i * now_.size;
            // The last usage applies to all further controls (section 6.2.2.8).
            if (!field.array && !usages_.empty()) field.usage = usages_[std::min<std::size_t>(i, usages_.size() - 1)];
            out_.fields.push_back(field);
        }
        return {};
    }

    const std::span<const std::uint8_t> bytes_;
    std::size_t at_ = 0;
    std::size_t item_ = 0;
    HidDescriptor out_;
    Globals now_;
    std::vector<Globals> pushed_;
    std::vector<Usage> usages_;
    std::optional<Usage> usageMin_;
    std::uint16_t open_ = kNoCollection;
    std::size_t depth_ = 0;
    bool unnumbered_ = false;
};

constexpr Word<ReportKind> kReportKinds[] = {
    {"input", ReportKind::Input}, {"output", ReportKind::Output}, {"feature", ReportKind::Feature}};

}  // namespace

std::string_view nameOf(ReportKind kind) noexcept { return wordFor(kReportKinds, kind); }

std::optional<std::size_t> HidDescriptor::lengthOf(ReportKind kind, std::uint8_t number) const noexcept {
    for (const auto& report : reports) {
        if (report.kind == kind && report.number == number) return 1 + (std::size_t{report.bits} + 7) / 8;
    }
    return std::nullopt;
}

std::uint16_t HidDescriptor::enclosing(std::uint16_t collection, Usage usage) const noexcept {
    // A parent always comes before its children in the list, so this loop ends.
    while (collection != kNoCollection && collections[collection].usage != usage) {
        collection = collections[collection].parent;
    }
    return collection;
}

bool HidDescriptor::isInside(std::uint16_t collection, Usage usage) const noexcept {
    return enclosing(collection, usage) != kNoCollection;
}

Result<HidDescriptor> parseHidDescriptor(std::span<const std::uint8_t> bytes) { return Parser(bytes).run(); }

}  // namespace tacto::hid
