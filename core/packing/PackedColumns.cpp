#include "core/packing/PackedColumns.h"

#include <algorithm>
#include <array>
#include <bit>
#include <cmath>
#include <cstring>
#include <limits>
#include <utility>
#include <zstd.h>

namespace tacto {

namespace {

constexpr std::size_t kHeadBytes = 36;
constexpr std::size_t kWord = 8;
constexpr int kLevel = 1;                // zstd's fastest level with entropy coding
constexpr std::size_t kLooked = 512;     // values that show whether a column has a step
constexpr double kMaxNumber = 0x1p50;    // below this, rounding to a whole number is exact
constexpr double kRounder = 0x1.8p52;    // x + kRounder - kRounder rounds x to a whole number
constexpr std::size_t kFittingBits = 8;  // of a rest, on average, for a grid that fits
constexpr int kSkipped = 15;  // chunks without another try: after one that did not shrink, or a column without a step

using Integers = std::vector<std::uint64_t>;

std::uint64_t folded(std::uint64_t difference) noexcept { return difference << 1U ^ (0 - (difference >> 63U)); }

/// The values base + k * step.
struct Grid {
    double base = 0;
    double step = 0;  ///< 0: the column has no step

    [[nodiscard]] double number(double value) const noexcept {
        const double number = (value - base) / step;
        return std::abs(number) < kMaxNumber ? number + kRounder - kRounder : 0;  // also 0 for NaN and without a step
    }
    [[nodiscard]] std::uint64_t rest(double value, double number) const noexcept {
        return std::bit_cast<std::uint64_t>(value) - std::bit_cast<std::uint64_t>(base + number * step);
    }
    /// Returns about how many bits the rests take.
    [[nodiscard]] std::size_t cost(std::span<const double> values) const noexcept {
        std::size_t bits = 0;
        for (const double value : values)
            bits += static_cast<std::size_t>(std::bit_width(folded(rest(value, number(value)))));
        return bits;
    }
    [[nodiscard]] bool fits(std::span<const double> values) const noexcept {
        return cost(values) <= kFittingBits * values.size();
    }
};

/// Returns the largest step of which all differences to `base` are whole multiples, by Euclid's algorithm; 0 without
/// one.
double commonStep(std::span<const double> values, double base) noexcept {
    double largest = 0;
    for (const double value : values)
        if (std::isfinite(value)) largest = std::max(largest, std::abs(value - base));
    const double noise = largest * 0x1p-28;  // what rounding may leave of a whole multiple
    double common = largest;
    for (const double value : values) {
        double left = std::abs(value - base);
        if (!std::isfinite(left)) continue;
        while (left > noise) {
            left = std::fmod(std::exchange(common, left), left);
            if (common - left <= noise) left = 0;
        }
        common = largest / std::round(largest / common);  // exactly, so that errors do not add up
    }
    return common > noise && std::isfinite(common) ? common : 0;
}

/// Returns the grid on which most values lie, or one without a step.
Grid gridOf(std::span<const double> values) noexcept {
    const auto looked = values.first(std::min(kLooked, values.size()));
    double nearest = std::numeric_limits<double>::infinity();  // to 0, so the least rounded
    for (const double value : looked)
        if (std::abs(value) < std::abs(nearest)) nearest = value;
    Grid best;
    std::size_t least = kFittingBits * looked.size();
    for (const double base : {0.0, nearest}) {
        const double near = commonStep(looked, base);
        if (!(near > 0)) continue;
        for (const double step : {near, static_cast<double>(static_cast<float>(near)), std::nextafter(near, 0),
                                  std::nextafter(near, 2 * near)}) {
            const auto cost = Grid{base, step}.cost(looked);
            if (cost >= least) continue;
            least = cost;
            best = {base, step};
        }
        if (best.step != 0) break;
    }
    return best;
}

/// How one row of integers is stored.
struct Coding {
    std::uint64_t start = 0;
    std::uint8_t order = 0;
    std::uint8_t width = 0;
};

/// Replaces integers by differences. The order is the one with the shorter differences in the first few.
Coding takeDifferences(std::span<std::uint64_t> words) noexcept {
    Coding coding;
    coding.start = words.front();
    if (std::ranges::all_of(words, [&](std::uint64_t word) { return word == coding.start; })) return coding;
    const auto [low, high] =
        std::ranges::minmax(words, {}, [](std::uint64_t word) { return static_cast<std::int64_t>(word); });
    const auto middle = low + (high - low) / 2;
    std::array<std::uint64_t, 2> bits{};
    for (std::size_t i = 1; i < std::min(2 * kLooked, words.size()); ++i) {
        bits[0] += static_cast<std::uint64_t>(std::bit_width(folded(words[i] - middle)));
        bits[1] += static_cast<std::uint64_t>(std::bit_width(folded(words[i] - words[i - 1])));
    }
    coding.order = bits[1] < bits[0] ? 1 : 0;
    coding.start = coding.order == 0 ? middle : words.front();
    std::uint64_t used = 0;
    std::uint64_t before = coding.start;
    for (auto& word : words) {
        const auto difference = folded(word - before);
        if (coding.order == 1) before = word;
        word = difference;
        used |= difference;
    }
    coding.width = static_cast<std::uint8_t>((std::bit_width(used) + 7) / 8);
    return coding;
}

/// For each significance, the bytes of integers.
using Planes = std::array<const std::byte*, kWord>;
constexpr std::size_t kAtOnce = 512;  // so few integers stay in the processor's cache

/// Puts the bytes of at most kAtOnce integers together, by halves: such loops become vector instructions.
template <class Word>
void join(const std::byte* const* planes, std::size_t count, Word* to) noexcept {
    if constexpr (sizeof(Word) == 2) {
        for (std::size_t i = 0; i < count; ++i)
            to[i] = static_cast<Word>(static_cast<Word>(planes[0][i]) | static_cast<Word>(planes[1][i]) << 8);
    } else {
        using Half = std::conditional_t<sizeof(Word) == 8, std::uint32_t, std::uint16_t>;
        std::array<Half, kAtOnce> low, high;
        join(planes, count, low.data());
        join(planes + sizeof(Half), count, high.data());
        for (std::size_t i = 0; i < count; ++i) to[i] = low[i] | static_cast<Word>(high[i]) << 8 * sizeof(Half);
    }
}

/// Reads the integers of one column, at most kAtOnce at a time.
class IntegersIn {
public:
    /// `next` goes on to the planes of the next column.
    IntegersIn(const Coding& coding, Planes& next, std::size_t samples) noexcept
        : coding_(coding), before_(coding.start) {
        static constexpr std::array<std::byte, kAtOnce> kZeros{};
        planes_.fill(kZeros.data());
        for (std::size_t byte = 0; byte < coding.width; ++byte) next[byte] = (planes_[byte] = next[byte]) + samples;
    }
    void read(std::span<std::uint64_t> to) noexcept {
        if (coding_.width > 4)
            readAs<std::uint64_t>(to);
        else if (coding_.width > 2)
            readAs<std::uint32_t>(to);
        else if (coding_.width > 0)
            readAs<std::uint16_t>(to);
        else
            std::ranges::fill(to, coding_.start);
    }

private:
    template <class Word>
    void readAs(std::span<std::uint64_t> to) noexcept {
        std::array<Word, kAtOnce> words;
        join(planes_.data(), to.size(), words.data());
        for (std::size_t byte = 0; byte < coding_.width; ++byte) planes_[byte] += to.size();
        const auto difference = [&](std::size_t i) {
            const auto unfolded = static_cast<Word>(words[i] >> 1U ^ (0 - (words[i] & 1U)));
            return static_cast<std::uint64_t>(static_cast<std::make_signed_t<Word>>(unfolded));
        };
        const auto start = coding_.start;
        auto before = before_;  // not of the object, where every sum would go through memory
        if (coding_.order == 0)
            for (std::size_t i = 0; i < to.size(); ++i) to[i] = start + difference(i);
        else
            for (std::size_t i = 0; i < to.size(); ++i) to[i] = before += difference(i);
        before_ = before;
    }

    Coding coding_;
    std::uint64_t before_;
    Planes planes_;
};

struct ColumnHead {
    Grid grid;
    Coding numbers, rests;
};

std::byte* write(const ColumnHead& head, std::byte* to) noexcept {
    const auto put = [&](const auto& value) {
        std::memcpy(to, &value, sizeof value);
        to += sizeof value;
    };
    put(head.grid.base);
    put(head.grid.step);
    for (const auto* coding : {&head.numbers, &head.rests}) {
        put(coding->start);
        put(coding->order);
        put(coding->width);
    }
    return to;
}

/// Calls `plane` for each byte of each column that is stored, and returns the place behind the last.
template <class Byte, class Plane>
Byte* eachPlane(std::span<const ColumnHead> heads, Coding ColumnHead::*part, Byte* at, Plane plane) {
    for (std::size_t byte = 0; byte < kWord; ++byte)
        for (std::size_t column = 0; column < heads.size(); ++column)
            if ((heads[column].*part).width > byte) at = plane(column, byte, at);
    return at;
}

void scatter(std::span<const std::uint64_t> words, std::size_t byte, std::byte* to) noexcept {
    for (std::size_t i = 0; i < words.size(); ++i) to[i] = static_cast<std::byte>(words[i] >> 8 * byte);
}

ColumnHead readHead(const std::byte* from) noexcept {
    ColumnHead head;
    const auto get = [&](auto& value) {
        std::memcpy(&value, from, sizeof value);
        from += sizeof value;
    };
    get(head.grid.base);
    get(head.grid.step);
    for (auto* coding : {&head.numbers, &head.rests}) {
        get(coding->start);
        get(coding->order);
        get(coding->width);
    }
    return head;
}

}  // namespace

struct ColumnPacker::State {
    struct Free {
        void operator()(ZSTD_CCtx* owned) const noexcept { ZSTD_freeCCtx(owned); }
    };
    std::unique_ptr<ZSTD_CCtx, Free> context{ZSTD_createCCtx()};
    struct Known {
        Grid grid;
        int skipped = 0;
    };
    std::vector<Known> known;  // of the chunk before
    std::vector<double> column;
    std::vector<ColumnHead> heads;
    Integers numbers, rests;  // one column after the other
    std::vector<std::byte> content, packed;
    int skipped = 0;

    void take(std::size_t index, std::size_t samples) {
        auto& [grid, left] = known[index];
        const auto sample = std::span(column).first(std::min(kLooked, samples));
        if (left > 0) {
            --left;
        } else if (!grid.fits(sample)) {
            grid = gridOf(column);
            if (grid.step == 0) left = kSkipped;
        }
        const auto numbersOf = std::span(numbers).subspan(index * samples, samples);
        const auto restsOf = std::span(rests).subspan(index * samples, samples);
        for (std::size_t i = 0; i < samples; ++i) {
            const double number = grid.number(column[i]);
            numbersOf[i] = std::bit_cast<std::uint64_t>(number + kRounder) - std::bit_cast<std::uint64_t>(kRounder);
            restsOf[i] = grid.rest(column[i], number);
        }
        heads[index] = {grid, takeDifferences(numbersOf), takeDifferences(restsOf)};
    }

    /// Empty if the result does not fit into `packed`. Each byte of the numbers gets an entropy code of its own.
    [[nodiscard]] std::span<const std::byte> compress(std::size_t samples) {
        ZSTD_CCtx_reset(context.get(), ZSTD_reset_session_only);
        ZSTD_CCtx_setParameter(context.get(), ZSTD_c_compressionLevel, kLevel);
        ZSTD_CCtx_setPledgedSrcSize(context.get(), content.size());
        ZSTD_outBuffer out{packed.data(), packed.size(), 0};
        auto* end = content.data();
        const auto* begin = end;
        bool fits = true;
        const auto compressed = [&](ZSTD_EndDirective how) {
            ZSTD_inBuffer in{begin, static_cast<std::size_t>(end - begin), 0};
            fits = fits && ZSTD_compressStream2(context.get(), &out, &in, how) == 0;  // an error or what is left
            begin = end;
        };
        for (const auto& head : heads) end = write(head, end);
        compressed(ZSTD_e_flush);
        for (const auto& [part, words] : {std::pair(&ColumnHead::numbers, &numbers), {&ColumnHead::rests, &rests}}) {
            std::size_t last = 0;
            end = eachPlane(heads, part, end, [&](std::size_t index, std::size_t byte, std::byte* plane) {
                if (std::exchange(last, byte) != byte) compressed(ZSTD_e_flush);
                scatter(std::span(*words).subspan(index * samples, samples), byte, plane);
                return end = plane + samples;
            });
            compressed(ZSTD_e_flush);
        }
        compressed(ZSTD_e_end);
        return fits ? std::span<const std::byte>(packed).first(out.pos) : std::span<const std::byte>();
    }
};

ColumnPacker::ColumnPacker() : state_(std::make_unique<State>()) {}
ColumnPacker::~ColumnPacker() = default;
ColumnPacker::ColumnPacker(ColumnPacker&&) noexcept = default;
ColumnPacker& ColumnPacker::operator=(ColumnPacker&&) noexcept = default;

std::span<const std::byte> ColumnPacker::pack(const SampleBlock& block, bool withStamps) {
    auto& s = *state_;
    const auto samples = block.samples();
    const std::size_t stamps = withStamps ? 1 : 0;
    if (samples == 0 || s.context == nullptr) return {};
    const auto valueColumns = block.values.size() / samples;
    const auto columns = stamps + valueColumns;
    if (columns * samples > kMaxPackedNumbers) return {};
    if (s.skipped > 0) {
        --s.skipped;
        return {};
    }
    s.known.resize(columns);
    s.heads.resize(columns);
    s.column.resize(samples);
    s.numbers.resize(columns * samples);
    s.rests.resize(columns * samples);
    for (std::size_t c = 0; c < columns; ++c) {
        if (c < stamps) {
            s.column = block.t_s;
        } else {
            for (std::size_t i = 0; i < samples; ++i) s.column[i] = block.values[i * valueColumns + c - stamps];
        }
        s.take(c, samples);
    }

    std::size_t size = columns * kHeadBytes;
    for (const auto& head : s.heads) size += samples * (std::size_t{head.numbers.width} + head.rests.width);
    s.content.resize(size);
    const auto plain = columns * samples * sizeof(double);
    s.packed.resize(plain - plain / 10);
    const auto shrunk = s.compress(samples);
    s.skipped = shrunk.empty() ? kSkipped : 0;
    return shrunk;
}

Result<void> unpackColumns(std::span<const std::byte> packed, std::uint64_t samples, std::size_t columns,
                           bool withStamps, SampleBlock& into) {
    into.clear();
    const std::size_t stamps = withStamps ? 1 : 0;
    const auto wrong = [&] {
        return fail(ErrorCode::ParseError, "its {} bytes do not unpack to {} samples of {} columns", packed.size(),
                    samples, columns);
    };
    if (samples == 0 || columns == 0 || columns > kMaxPackedNumbers || samples > kMaxPackedNumbers / (stamps + columns))
        return wrong();
    const auto all = stamps + columns;
    const auto size = ZSTD_getFrameContentSize(packed.data(), packed.size());  // errors are larger than any size
    if (size < all * kHeadBytes || size > all * (kHeadBytes + 2 * kWord * samples)) return wrong();
    struct Free {
        void operator()(ZSTD_DCtx* owned) const noexcept { ZSTD_freeDCtx(owned); }
    };
    thread_local const std::unique_ptr<ZSTD_DCtx, Free> context{ZSTD_createDCtx()};
    thread_local std::vector<std::byte> content;
    content.resize(size);
    if (context == nullptr ||
        ZSTD_decompressDCtx(context.get(), content.data(), size, packed.data(), packed.size()) != size)
        return wrong();

    std::vector<ColumnHead> heads(all);
    std::size_t expected = all * kHeadBytes;
    for (std::size_t c = 0; c < all; ++c) {
        heads[c] = readHead(content.data() + c * kHeadBytes);
        for (const auto& coding : {heads[c].numbers, heads[c].rests}) {
            if (coding.order > 1 || coding.width > kWord) return wrong();
            expected += coding.width * samples;
        }
    }
    if (expected != size) return wrong();
    const auto* from = content.data() + all * kHeadBytes;
    const auto planesOf = [&](Coding ColumnHead::*part) {
        Planes first{};
        from = eachPlane(std::span<const ColumnHead>(heads), part, from,
                         [&](std::size_t, std::size_t byte, const std::byte* plane) {
                             if (first[byte] == nullptr) first[byte] = plane;
                             return plane + samples;
                         });
        return first;
    };
    auto nextNumbers = planesOf(&ColumnHead::numbers), nextRests = planesOf(&ColumnHead::rests);
    into.t_s.resize(samples);
    into.values.resize(columns * samples);
    std::array<std::uint64_t, kAtOnce> number, rest;
    for (std::size_t c = 0; c < all; ++c) {
        auto* to = c < stamps ? into.t_s.data() : into.values.data() + (c - stamps);
        const std::size_t apart = c < stamps ? 1 : columns;
        const auto& grid = heads[c].grid;
        IntegersIn numbers(heads[c].numbers, nextNumbers, samples), rests(heads[c].rests, nextRests, samples);
        for (std::size_t left = samples; left > 0;) {
            const auto some = std::min(left, number.size());
            numbers.read(std::span(number).first(some));
            rests.read(std::span(rest).first(some));
            for (std::size_t i = 0; i < some; ++i) {
                const double near = grid.base + static_cast<double>(static_cast<std::int64_t>(number[i])) * grid.step;
                to[i * apart] = std::bit_cast<double>(std::bit_cast<std::uint64_t>(near) + rest[i]);
            }
            to += some * apart;
            left -= some;
        }
    }
    return {};
}

}  // namespace tacto
