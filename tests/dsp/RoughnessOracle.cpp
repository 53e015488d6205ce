#include "tests/dsp/RoughnessOracle.h"

#include <cmath>
#include <complex>
#include <gtest/gtest.h>
#include <limits>
#include <numbers>

#include "core/base/Random.h"
#include "core/base/Statistics.h"

namespace tacto::test {

namespace {

constexpr double kPi = std::numbers::pi;
using Complex = std::complex<double>;
using Series = std::vector<double>;

const SampleBlock* blockOf(StreamKind kind, std::span<const StreamInfo> streams, std::span<const SampleBlock> blocks,
                           StreamInfo* info = nullptr) {
    for (std::size_t i = 0; i < streams.size(); ++i) {
        if (streams[i].kind != kind) continue;
        if (info != nullptr) *info = streams[i];
        return &blocks[i];
    }
    return nullptr;
}

/// Returns the polynomial with the given roots, highest power first.
std::vector<Complex> polynomial(const std::vector<Complex>& roots) {
    std::vector<Complex> p{1};
    for (const auto& r : roots) {
        p.push_back(0);
        for (std::size_t i = p.size() - 1; i > 0; --i) p[i] -= r * p[i - 1];
    }
    return p;
}

/// Filters with order 4 in one step. Before the start, x is constant and y is zero.
Series bandpass(const Series& x, double low, double high, double fs) {
    const double wl = 2 * fs * std::tan(kPi * low / fs);
    const double wh = 2 * fs * std::tan(kPi * high / fs);
    std::vector<Complex> poles;
    for (const double sign : {1.0, -1.0}) {
        const Complex p = std::exp(Complex(0, sign * 0.75 * kPi)) * (wh - wl);
        for (const double branch : {1.0, -1.0}) poles.push_back(0.5 * (p + branch * std::sqrt(p * p - 4 * wl * wh)));
    }
    Complex gain = (wh - wl) * (wh - wl) * (2 * fs) * (2 * fs);
    std::vector<Complex> z;
    for (const auto& p : poles) {
        gain /= 2 * fs - p;
        z.push_back((2 * fs + p) / (2 * fs - p));
    }
    const auto a = polynomial(z);
    const double b[5] = {gain.real(), 0, -2 * gain.real(), 0, gain.real()};
    Series y(x.size());
    for (std::size_t n = 0; n < x.size(); ++n) {
        double sum = 0;
        for (std::size_t k = 0; k < 5; ++k) sum += b[k] * (n >= k ? x[n - k] : x[0]);
        for (std::size_t k = 1; k < 5; ++k) sum -= a[k].real() * (n >= k ? y[n - k] : 0);
        y[n] = sum;
    }
    return y;
}

double interpolate(const SampleBlock& force, double t) {
    if (t <= force.t_s.front()) return force.values.front();
    for (std::size_t i = 1; i < force.samples(); ++i) {
        if (t > force.t_s[i]) continue;
        const double w = (t - force.t_s[i - 1]) / (force.t_s[i] - force.t_s[i - 1]);
        return force.values[i - 1] + w * (force.values[i] - force.values[i - 1]);
    }
    return force.values.back();
}

struct Contact {
    std::vector<bool> state;  // one per force sample
    double first = std::numeric_limits<double>::infinity();
};
Contact contactOf(const SampleBlock& force) {
    Contact out;
    bool on = false;
    for (std::size_t i = 0; i < force.samples(); ++i) {
        on = on ? force.values[i] >= 0.05 : force.values[i] >= 0.1;
        if (on && std::isinf(out.first)) out.first = force.t_s[i];
        out.state.push_back(on);
    }
    return out;
}
bool contactAt(const SampleBlock& force, const Contact& contact, double t) {
    for (std::size_t i = force.samples(); i-- > 0;) {
        if (force.t_s[i] <= t) return contact.state[i] && t - force.t_s[i] <= 0.1 + 1e-9;
    }
    return false;
}

struct Spectra {
    Series undone;  // mean square of the acceleration before normalisation
    Series t, meanSquare, h, hAbs, begin, end;
    double hop_s = 0;
};
Spectra spectraOf(const SampleBlock& block, const StreamInfo& info, const SampleBlock* force, double bandLow) {
    const double fs = info.rate_hz;
    const double top = fs < 2000 / 0.9 ? 0.45 * fs : 1000;
    std::vector<Series> axes(info.channels);
    std::vector<Series> bare(info.channels);
    for (std::size_t c = 0; c < info.channels; ++c) {
        Series x;
        for (std::size_t i = 0; i < block.samples(); ++i) x.push_back(block.values[i * info.channels + c]);
        axes[c] = bare[c] = bandpass(x, 5, top, fs);
        for (std::size_t i = 0; i < x.size() && force != nullptr; ++i) {
            axes[c][i] /= std::max(interpolate(*force, block.t_s[i]), 0.1);
        }
    }
    const auto n = static_cast<std::size_t>(std::lround(0.064 * fs));
    const auto hop = static_cast<std::size_t>(std::lround(0.016 * fs));
    Series w;
    double energy = 0;
    for (std::size_t i = 0; i < n; ++i) {
        w.push_back(std::pow(std::sin(kPi * static_cast<double>(i) / static_cast<double>(n)), 2));
        energy += w.back() * w.back();
    }
    std::vector<Complex> wave;  // e^(-2πi m/n)
    for (std::size_t m = 0; m < n; ++m) {
        wave.push_back(std::polar(1.0, -2 * kPi * static_cast<double>(m) / static_cast<double>(n)));
    }
    Spectra out;
    out.hop_s = static_cast<double>(hop) / fs;
    for (std::size_t first = 0; first + n <= block.samples(); first += hop) {
        double whole = 0;
        double rough = 0;
        double undone = 0;
        for (std::size_t k = 1; k <= n / 2; ++k) {
            const double f = static_cast<double>(k) * fs / static_cast<double>(n);
            if (f < 5 || f > top) continue;
            const auto power = [&](const std::vector<Series>& signals) {
                double sum = 0;
                for (const auto& signal : signals) {
                    double real = 0;
                    double imaginary = 0;
                    for (std::size_t i = 0; i < n; ++i) {
                        real += signal[first + i] * w[i] * wave[k * i % n].real();
                        imaginary += signal[first + i] * w[i] * wave[k * i % n].imag();
                    }
                    sum += 2 * (real * real + imaginary * imaginary) / (fs * energy) * fs / static_cast<double>(n);
                }
                return sum;
            };
            const double s = power(axes);
            undone += power(bare);
            whole += s;
            if (f >= bandLow) rough += s;
        }
        const double t0 = block.t_s.front() + static_cast<double>(first) / fs;
        out.t.push_back(t0 + static_cast<double>(n) / 2 / fs);
        out.begin.push_back(t0);
        out.end.push_back(t0 + static_cast<double>(n - 1) / fs);
        out.meanSquare.push_back(whole);
        out.undone.push_back(undone);
        out.h.push_back(top > bandLow && rough > 0 ? rough / whole : kNaN);
        out.hAbs.push_back(top > bandLow && rough > 0 ? rough : kNaN);
    }
    return out;
}

/// Returns v for each taxel sample.
Series taxelFeature(const SampleBlock& taxels, std::size_t channels, bool dynamic, const DeclaredIntervals& declared,
                    double firstContact) {
    const auto inBaseline = [&](double t) {
        if (declared.baseline) return t >= declared.baseline->begin_s && t <= declared.baseline->end_s;
        if (firstContact - taxels.t_s.front() >= 0.25) return t < firstContact;
        return t < taxels.t_s.front() + 0.25;
    };
    Series baseline(channels);
    Series means;
    for (std::size_t i = 0; i < taxels.samples(); ++i) {
        if (!inBaseline(taxels.t_s[i])) continue;
        double mean = 0;
        for (std::size_t c = 0; c < channels; ++c) {
            baseline[c] += taxels.values[i * channels + c];
            mean += taxels.values[i * channels + c] / static_cast<double>(channels);
        }
        means.push_back(mean);
    }
    const auto count = static_cast<double>(means.size());
    double centre = 0;
    double squares = 0;
    for (auto& b : baseline) b /= count;
    for (const double m : means) centre += m / count;
    for (const double m : means) squares += (m - centre) * (m - centre) / count;
    const double floor = 3 * std::sqrt(squares);

    const auto u = [&](std::size_t i, std::size_t c) {
        return std::max(taxels.values[i * channels + c] - baseline[c], 0.0);
    };
    Series out;
    for (std::size_t i = 0; i < taxels.samples(); ++i) {
        double mean = 0;
        Series x(channels);
        for (std::size_t c = 0; c < channels; ++c) {
            mean += u(i, c) / static_cast<double>(channels);
            x[c] = u(i, c);
            double sum = 0;
            double rows = 0;
            for (std::size_t j = 0; j <= i && dynamic; ++j) {
                if (!(taxels.t_s[j] > taxels.t_s[i] - 0.25)) continue;
                sum += u(j, c);
                ++rows;
            }
            if (dynamic) x[c] -= sum / rows;
        }
        double middle = 0;
        double variance = 0;
        for (const double one : x) middle += one / static_cast<double>(channels);
        for (const double one : x) variance += (one - middle) * (one - middle) / static_cast<double>(channels);
        out.push_back(mean > 0 && mean >= floor && variance > 0 ? variance / (mean * mean) : kNaN);
    }
    return out;
}

std::size_t nearestTo(const SampleBlock& block, double t) {
    std::size_t best = 0;
    for (std::size_t i = 1; i < block.samples(); ++i) {
        if (std::abs(block.t_s[i] - t) < std::abs(block.t_s[best] - t)) best = i;
    }
    return best;
}

double scaled(double x, const ReferenceScale& scale) {
    const double g = (std::log10(x) - std::log10(scale.smooth)) / (std::log10(scale.rough) - std::log10(scale.smooth));
    return std::min(std::max(g, 0.0), 1.0);
}

}  // namespace

std::vector<RoughnessFrame> oracleFrames(std::span<const StreamInfo> streams, std::span<const SampleBlock> blocks,
                                         const RoughnessSettings& s, const DeclaredIntervals& declared) {
    StreamInfo accelerationInfo{};
    StreamInfo taxelInfo{};
    const auto* acceleration = blockOf(StreamKind::Acceleration, streams, blocks, &accelerationInfo);
    const auto* force = blockOf(StreamKind::Force, streams, blocks);
    const auto* taxels = blockOf(StreamKind::Taxels, streams, blocks, &taxelInfo);

    Contact contact;
    if (force != nullptr) contact = contactOf(*force);
    double firstContact = force != nullptr ? contact.first : -std::numeric_limits<double>::infinity();
    if (force == nullptr && declared.contact) firstContact = declared.contact->front().begin_s;

    Spectra spectra;
    if (acceleration != nullptr) {
        spectra = spectraOf(*acceleration, accelerationInfo, force, s.bandLow.value());
    } else if (1 / taxelInfo.rate_hz > 0.016) {
        spectra.t = taxels->t_s;
        spectra.hop_s = 1 / taxelInfo.rate_hz;
    } else {
        spectra.hop_s = 0.016;
        for (int k = 0; taxels->t_s.front() + 0.016 * k <= taxels->t_s.back(); ++k) {
            spectra.t.push_back(taxels->t_s.front() + 0.016 * k);
        }
    }
    Series v;
    if (taxels != nullptr) {
        v = taxelFeature(*taxels, taxelInfo.channels, s.taxel == TaxelFeature::Dynamic, declared, firstContact);
    }

    std::vector<RoughnessFrame> frames;
    Series product;
    for (std::size_t k = 0; k < spectra.t.size(); ++k) {
        RoughnessFrame f;
        f.t_s = spectra.t[k];
        f.contact = true;
        double pressed = 1;
        if (force != nullptr) {
            f.contact = contactAt(*force, contact, f.t_s);
            const double newton = interpolate(*force, f.t_s);
            pressed = std::max(newton, 0.1);
            f.pressure_pa = newton / (s.contactArea.value() * 1e-4);
        } else if (declared.contact) {
            f.contact = false;
            for (const auto& c : *declared.contact) f.contact |= f.t_s >= c.begin_s && f.t_s <= c.end_s;
        }
        if (acceleration != nullptr) {
            f.h = s.spectral == SpectralFeature::Relative ? spectra.h[k] : spectra.hAbs[k];
            product.push_back(spectra.meanSquare[k] * pressed * pressed);
            // If force more than doubles within the window, one number cannot undo the normalisation. Both readings
            // must then show sliding (hazard H7).
            double smallest = pressed;
            double largest = pressed;
            for (double t = spectra.begin[k]; force != nullptr && t <= spectra.end[k]; t += 1e-4) {
                smallest = std::min(smallest, std::max(interpolate(*force, t), 0.1));
                largest = std::max(largest, std::max(interpolate(*force, t), 0.1));
            }
            if (largest > 2 * smallest) product.back() = std::min(product.back(), spectra.undone[k]);
        }
        if (taxels != nullptr) {
            const auto i = nearestTo(*taxels, f.t_s);
            f.v = v[i];
            if (force == nullptr && taxelInfo.unit == StreamUnit::Pascal) {
                f.pressure_pa = 0;
                for (std::size_t c = 0; c < taxelInfo.channels; ++c) {
                    f.pressure_pa +=
                        taxels->values[i * taxelInfo.channels + c] / static_cast<double>(taxelInfo.channels);
                }
            }
            // Until the first contact ends the rest, the baseline is unknown, so these frames have no v.
            if (!declared.baseline && firstContact - taxels->t_s.front() >= 0.25 && f.t_s < firstContact) f.v = kNaN;
        }
        if (!std::isnan(f.pressure_pa)) {
            const double p = (f.pressure_pa - s.pressureMin.value()) / (s.pressureMax.value() - s.pressureMin.value());
            f.P = std::min(std::max(p, 0.0), 1.0);
        }
        frames.push_back(f);
    }

    double rest = kNaN;
    double restFrames = 0;
    double restSum = 0;
    for (std::size_t k = 0; k < product.size(); ++k) {
        const bool resting =
            declared.baseline
                ? spectra.begin[k] >= declared.baseline->begin_s && spectra.end[k] <= declared.baseline->end_s
                : firstContact - acceleration->t_s.front() >= 0.25 && spectra.end[k] < firstContact;
        if (!resting) continue;
        restSum += product[k];
        ++restFrames;
    }
    if (restFrames > 0) rest = restSum / restFrames;

    const double alpha = 1 - std::exp(-spectra.hop_s / s.smoothing.count());
    double r = kNaN;
    double held = kNaN;
    double lastSliding = 0;
    for (std::size_t k = 0; k < frames.size(); ++k) {
        auto& f = frames[k];
        if (!f.contact) {
            r = kNaN;
            continue;
        }
        f.sliding = std::isnan(rest) || product.empty() || product[k] >= 3 * rest;
        double sum = 0;
        double weights = 0;
        if (!std::isnan(f.h)) {
            sum += s.spectralWeight * scaled(f.h, s.spectralScale());
            weights += s.spectralWeight;
        }
        if (!std::isnan(f.v)) {
            sum += s.taxelWeight * scaled(f.v, s.taxelScale());
            weights += s.taxelWeight;
        }
        if (f.sliding) {
            lastSliding = f.t_s;
            if (weights == 0) continue;
            r = std::isnan(r) ? sum / weights : r + alpha * (sum / weights - r);
            held = r;
        } else if (!std::isnan(r) && f.t_s - lastSliding > 0.25) {
            r = held * std::exp(-(f.t_s - lastSliding - 0.25) / 0.25);
        }
        f.R = r;
    }
    return frames;
}

Slide makeSlide(double acceleration_hz, std::size_t axes, double force_hz, double taxel_hz, std::size_t taxels,
                double seconds) {
    Random random(11, "slide");
    const auto touching = [](double t) { return t >= 1.0 && t < 4.5; };
    const auto sliding = [](double t) { return t >= 1.5 && t < 3.0; };
    Slide slide;
    const auto add = [&](StreamKind kind, StreamUnit unit, std::size_t channels, double rate, auto value) {
        if (channels == 0 || rate == 0) return;
        slide.streams.push_back({kind, unit, channels, rate, "slide"});
        auto& block = slide.blocks.emplace_back();
        for (std::size_t i = 0; i < static_cast<std::size_t>(seconds * rate); ++i) {
            block.t_s.push_back(static_cast<double>(i) / rate);
            for (std::size_t c = 0; c < channels; ++c) block.values.push_back(value(block.t_s.back(), c));
        }
    };
    add(StreamKind::Acceleration, StreamUnit::MetrePerSecondSquared, axes, acceleration_hz,
        [&](double t, std::size_t c) {
            const double texture = std::sin(2 * kPi * (140 + 60 * static_cast<double>(c)) * t) + 0.6 * random.normal();
            return 9.8 + 0.02 * random.normal() + (sliding(t) ? texture : 0);
        });
    add(StreamKind::Force, StreamUnit::Newton, force_hz > 0 ? 1 : 0, force_hz, [&](double t, std::size_t) {
        return (touching(t) ? 1.2 + 0.3 * std::sin(5 * t) : 0.01) + 0.002 * random.normal();
    });
    add(StreamKind::Taxels, StreamUnit::Pascal, taxels, taxel_hz, [&](double t, std::size_t c) {
        const double shape = 3000 + 900 * std::cos(static_cast<double>(c));
        const double ripple = sliding(t) ? 200 * std::sin(2 * kPi * 9 * t + static_cast<double>(c)) : 0;
        return 500 + 10 * static_cast<double>(c) + 5 * random.normal() + (touching(t) ? shape + ripple : 0);
    });
    return slide;
}

void expectSameFrames(std::span<const RoughnessFrame> actual, std::span<const RoughnessFrame> expected,
                      double tolerance) {
    ASSERT_EQ(actual.size(), expected.size());
    const auto same = [&](double a, double b, const char* what, double t) {
        ASSERT_EQ(std::isnan(a), std::isnan(b)) << what << " at " << t << " s: " << a << " and " << b;
        if (!std::isnan(a)) {
            ASSERT_LE(std::abs(a - b), tolerance * std::abs(b)) << what << " at " << t << " s";
        }
    };
    for (std::size_t i = 0; i < actual.size(); ++i) {
        const auto& a = actual[i];
        const auto& b = expected[i];
        same(a.t_s, b.t_s, "t_s", b.t_s);
        ASSERT_EQ(a.contact, b.contact) << b.t_s;
        ASSERT_EQ(a.sliding, b.sliding) << b.t_s;
        same(a.h, b.h, "h", b.t_s);
        same(a.v, b.v, "v", b.t_s);
        same(a.R, b.R, "R", b.t_s);
        same(a.pressure_pa, b.pressure_pa, "pressure", b.t_s);
        same(a.P, b.P, "P", b.t_s);
    }
}

}  // namespace tacto::test
