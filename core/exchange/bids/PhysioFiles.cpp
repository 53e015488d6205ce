#include "core/exchange/bids/PhysioFiles.h"

#include <algorithm>
#include <cmath>
#include <set>

#include "core/base/JsonText.h"
#include "core/exchange/ExportTables.h"
#include "core/exchange/SlotFinder.h"
#include "core/exchange/bids/TsvOut.h"

namespace tacto {

namespace {

using nlohmann::json;

constexpr double kMaxLost = 0.01;
// More places for a sample than these are out of proportion, unless they are few.
constexpr double kMaxPlaces = 50, kFewPlaces = 10'000'000;

/// Visits the samples of a stream that have a place on its grid.
using VisitSlot = std::function<Result<void>(SlotFinder::Place, const double* values)>;

class GridStream {
public:
    GridStream(const ExportSource& source, const ExportStream& stream) : source_(source), stream_(stream) {
        const bool declared = !(stream.rate_hz > 0) && stream.declaredRate_hz > 0;
        rate_hz_ = declared ? stream.declaredRate_hz : stream.rate_hz;
        if (stream.samples < 2 && !(rate_hz_ > 0)) rate_hz_ = 1;  // no second sample is to be placed by it
    }

    [[nodiscard]] double rate_hz() const noexcept { return rate_hz_; }
    [[nodiscard]] const GridCounts& counts() const noexcept { return counts_; }

    /// Looks how the samples lie on the grid. Returns why the stream is left out; empty if it is not.
    [[nodiscard]] Result<std::string> look() {
        if (!(rate_hz_ > 0) || !std::isfinite(rate_hz_)) return std::string("its stamps do not rise: it has no rate");
        std::uint64_t places = 0;
        auto read = eachSlot([&](SlotFinder::Place place, const double*) -> Result<void> {
            places = place.slot + 1;
            return {};
        });
        if (!read) return failure(read);
        const auto samples = static_cast<double>(stream_.samples), all = static_cast<double>(places);
        if (static_cast<double>(counts_.dropped) > kMaxLost * samples)
            return fmt::format(
                "it is not sampled regularly: {} of {} samples would share the place of another; csv, "
                "hdf5 and xdf hold it",
                counts_.dropped, stream_.samples);
        if (all > kFewPlaces && all > kMaxPlaces * samples)
            return fmt::format("its {} samples would be spread over {} places; csv, hdf5 and xdf hold it",
                               stream_.samples, places);
        return std::string();
    }

    [[nodiscard]] Result<void> write(const std::filesystem::path& path) {
        TsvOut out(path, TsvOut::Packing::Gzip);
        const auto width = stream_.channels.size();
        std::vector<double> kept(width, kNaN);
        const std::vector<double> absent(width, kNaN);
        std::uint64_t next = 0;  // place that is written next
        bool holds = false;      // whether `kept` waits for its place, which a later sample may take
        const auto row = [&](const std::vector<double>& values) {
            for (const double value : values) out.number(value);
            ++next;
            return out.endRow();
        };
        const auto fillUntil = [&](std::uint64_t slot) -> Result<void> {
            constexpr std::uint64_t kAsk = 1 << 14;
            while (next < slot) {
                if (auto written = row(absent); !written) return written;
                if (next % kAsk == 0)
                    if (auto on = source_.goOn(); !on) return on;
            }
            return {};
        };
        auto read = eachSlot([&](SlotFinder::Place place, const double* values) -> Result<void> {
            if (holds && place.slot > next) {
                if (auto written = row(kept); !written) return written;
                if (place.slipped)
                    if (auto written = row(kept); !written) return written;
            }
            if (auto filled = fillUntil(place.slot); !filled) return filled;
            std::copy(values, values + width, kept.begin());
            holds = true;
            return {};
        });
        if (!read) return read;
        if (holds)
            if (auto written = row(kept); !written) return written;
        return out.end();
    }

private:
    [[nodiscard]] Result<void> eachSlot(const VisitSlot& visit) {
        SlotFinder finder(rate_hz_, rate_hz_);
        const auto width = stream_.channels.size();
        auto read = source_.forEachChunk(stream_, [&](const SampleBlock& block) -> Result<void> {
            for (std::size_t i = 0; i < block.samples(); ++i) {
                const auto place = finder.next(block.t_s[i] - stream_.first_s);
                if (!place) continue;
                if (auto visited = visit(*place, block.values.data() + i * width); !visited) return visited;
            }
            return {};
        });
        counts_ = finder.counts();
        return read;
    }

    const ExportSource& source_;
    const ExportStream& stream_;
    double rate_hz_;
    GridCounts counts_;
};

json sidecarOf(const ExportSource& source, const ExportStream& stream, const GridStream& grid,
               const BidsFolder& folder) {
    std::vector<BidsColumn> columns;
    auto names = json::array();
    for (const auto& channel : stream.channels) {
        names.push_back(channel.name);
        columns.push_back({channel.name, fmt::format("{} of {}", channel.name, stream.title), bidsUnit(channel.unit)});
    }
    auto about = folder.sidecar(stream.simulated);
    about["SamplingFrequency"] = grid.rate_hz();
    about["StartTime"] = stream.samples > 0 ? stream.first_s : 0;
    about["Columns"] = std::move(names);
    about["PhysioType"] = "generic";
    about["Description"] = stream.title;
    about["Kind"] = stream.kind;
    about["Samples"] = stream.samples;
    about["Gaps"] = stream.gapCount;
    about["RepeatedSamples"] = grid.counts().repeated;
    about["DroppedSamples"] = grid.counts().dropped;
    about["MaxTimeError"] = grid.counts().maxTimeError_s;
    about["MeasuredSamplingFrequency"] = numberOrNull(stream.measuredRate_hz);
    about["TimeNote"] =
        "Row k is at StartTime + k / SamplingFrequency, in s since the session's start; each sample "
        "stands at the row nearest to its stamp, at most MaxTimeError (s) from it.";
    if (stream.samples < 2) about["SamplingFrequencyNote"] = "Fewer than 2 samples: no rate was measured.";
    about.update(BidsTable(columns).sidecar());
    if (const auto r = stream.channelR()) about[stream.channels[*r].name]["Calibrated"] = source.calibratedR();
    return about;
}

}  // namespace

Result<void> writePhysioFiles(const ExportSource& source, const BidsFolder& folder, ExportReport& report) {
    std::set<std::string> taken;
    for (const auto& stream : source.streams()) {
        GridStream grid(source, stream);
        auto why = grid.look();
        if (!why) return failure(why);
        if (!why->empty()) {
            report.leftOut.push_back({stream.name, std::move(*why)});
            continue;
        }
        const auto label = uniqueName(bidsLabelOf(stream.name, "stream"), "x", taken);
        const auto table = folder.path("beh", fmt::format("recording-{}_physio.tsv.gz", label));
        if (!table) return failure(table);
        if (auto written = grid.write(*table); !written) return written;
        const auto sidecar = folder.path("beh", fmt::format("recording-{}_physio.json", label));
        if (!sidecar) return failure(sidecar);
        if (auto written = folder.writeJson(*sidecar, sidecarOf(source, stream, grid, folder)); !written)
            return written;
        report.wroteExactly(stream);
        auto& said = report.streams.back();
        said.rate_hz = grid.rate_hz();
        said.repeated = grid.counts().repeated;
        said.dropped = grid.counts().dropped;
        said.maxTimeError_s = grid.counts().maxTimeError_s;
    }
    return {};
}

}  // namespace tacto
