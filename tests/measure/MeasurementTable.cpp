// measurement_table [SEEDS]: bias and spread of every figure over the grid of MeasurementGrid.h, as Markdown.
#include <cstdlib>
#include <fmt/format.h>

#include "tests/measure/MeasurementGrid.h"

namespace {

using tacto::test::GridPoint;
using tacto::test::PulseShape;

std::string biasAndSpread(const tacto::Statistics& s, double times) {
    if (s.n == 0) return "–";
    return fmt::format("{:+.3g} ± {:.2g}", times * s.mean, times * (s.n > 1 ? s.sd : 0));
}

/// The share not covered: amplitude, width, gap, charge, imbalance.
std::string notCovered(const tacto::test::GridResult& r) {
    if (r.amplitude.n == 0) return "–";
    const auto percent = [](int beyond, std::size_t n) {
        return n == 0 ? "–" : fmt::format("{:.0f}", 100.0 * beyond / static_cast<double>(n));
    };
    return fmt::format("{} {} {} {} {}", percent(r.beyondAmplitude, r.amplitude.n), percent(r.beyondWidth, r.width.n),
                       percent(r.beyondGap, r.gap.n), percent(r.beyondCharge, r.charge.n),
                       percent(r.beyondImbalance, r.gap.n));
}

void print(const char* title, const std::vector<GridPoint>& points, int seeds) {
    fmt::print(
        "\n## {}\n\n| point | amplitude % | width | interval | gap | charge % | imbalance % | pulses | missed | "
        "flagged | invented | warned | silent |\n|---|---|---|---|---|---|---|---|---|---|---|---|---|\n",
        title);
    for (const auto& point : points) {
        const auto r = tacto::test::measureGridPoint(point, seeds);
        fmt::print("| {} | {} | {} | {} | {} | {} | {} | {} | {} | {} | {} | {} | {} | {} |\n", describe(point),
                   biasAndSpread(r.amplitude, 100), biasAndSpread(r.width, 1), biasAndSpread(r.interval, 1),
                   biasAndSpread(r.gap, 1), biasAndSpread(r.charge, 100), biasAndSpread(r.imbalance, 100), r.pulses,
                   r.missed, r.flagged, r.invented, r.warned, r.silent, notCovered(r));
    }
}

}  // namespace

int main(int argc, char** argv) {
    const int seeds = argc > 1 ? std::atoi(argv[1]) : 20;
    if (seeds < 1) {
        fmt::print(stderr, "measurement_table [SEEDS]: SEEDS is '{}'; a whole number from 1 on is expected\n", argv[1]);
        return 2;
    }
    fmt::print(
        "# Pulses of known truth, measured: bias ± standard deviation over {} records a point\n\nTimes in "
        "samples. Silent: records with a missed or invented pulse, or half a biphasic one, and no warning. Not "
        "covered: readings further off than twice the stated uncertainty, of amplitude, width, gap, charge, "
        "imbalance; 5 is what is meant.\n",
        seeds);
    const PulseShape shapes[] = {PulseShape::Monophasic, PulseShape::Symmetric, PulseShape::Recharge,
                                 PulseShape::Exponential, PulseShape::Logic};
    std::vector<GridPoint> points;
    for (const auto shape : shapes) {
        for (const double perPhase : {8.0, 10.5, 20.0, 100.0, 1000.0}) {
            if (shape == PulseShape::Logic) {
                points.push_back({.shape = shape, .perPhase = perPhase});
                continue;
            }
            for (const double snr : {60.0, 40.0, 30.0, 26.0, 22.0, 18.0, 14.0, 8.0, 2.0}) {
                points.push_back({.shape = shape, .perPhase = perPhase, .snr_db = snr});
            }
        }
    }
    print("Noise and sampling", points, seeds);

    points.clear();
    for (const auto shape : {PulseShape::Monophasic, PulseShape::Symmetric, PulseShape::Recharge}) {
        for (const double share : {0.9, 0.5, 0.2, 0.1}) {
            for (const double perPhase : {20.0, 100.0}) {
                points.push_back({.shape = shape, .perPhase = perPhase, .snr_db = 60, .rangeShare = share});
            }
            points.push_back({.shape = shape, .perPhase = 100, .snr_db = 100, .rangeShare = share});
        }
    }
    print("8-bit steps", points, seeds);

    points.clear();
    for (const auto shape : {PulseShape::Monophasic, PulseShape::Symmetric, PulseShape::Recharge}) {
        for (const double ringing : {0.05, 0.1, 0.2, 0.3, 0.5}) {
            for (const double perPhase : {30.0, 100.0, 1000.0}) {
                points.push_back({.shape = shape, .perPhase = perPhase, .snr_db = 46, .ringing = ringing});
            }
        }
    }
    print("Ringing", points, seeds);

    points.clear();
    for (const auto shape : {PulseShape::Monophasic, PulseShape::Symmetric, PulseShape::Recharge}) {
        for (const double share : {0.02, 0.1, 0.3, 1.0}) {
            points.push_back({.shape = shape, .snr_db = 46, .slope = share});
            points.push_back({.shape = shape, .snr_db = 46, .hum = share});
            points.push_back({.shape = shape, .snr_db = 46, .hum = share, .interval = 100});
            points.push_back({.shape = shape, .snr_db = 46, .offset = share});
        }
    }
    print("Drift, hum and offset", points, seeds);

    points.clear();
    for (const auto shape : {PulseShape::Monophasic, PulseShape::Symmetric, PulseShape::Recharge}) {
        for (const double interval : {2.0, 3.0, 4.0, 15.0, 100.0, 1000.0, 10'000.0}) {
            if (shape != PulseShape::Monophasic && interval < 4) continue;
            if (shape == PulseShape::Recharge && interval < 15) continue;
            for (const int polarity : {1, -1}) {
                points.push_back({.shape = shape,
                                  .perPhase = interval > 1000 ? 20.0 : 50.0,
                                  .snr_db = 40,
                                  .interval = interval,
                                  .pulses = interval > 1000 ? 2 : 6,
                                  .polarity = polarity});
            }
        }
    }
    print("Duty and polarity", points, seeds);
    return 0;
}
