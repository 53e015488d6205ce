#include "core/measure/SampleView.h"

namespace tacto {

SampleView asRecorded(const Capture& capture, const CaptureChannel& channel) {
    SampleView view;
    view.capture = &capture;
    view.channel = &channel;
    view.samples = channel.samples;
    view.rate_hz = capture.rate_hz;
    view.start_s = capture.start_s;
    return view;
}

SampleView averaged(const SampleView& view, std::size_t mean) {
    SampleView result;
    result.capture = view.capture;
    result.channel = view.channel;
    result.mean = view.mean * mean;
    result.rate_hz = view.rate_hz / static_cast<double>(mean);
    result.start_s = view.timeOf(0.5 * static_cast<double>(mean - 1));
    result.own.resize(view.samples.size() / mean);
    const double share = 1.0 / static_cast<double>(mean);
    const float* sample = view.samples.data();
    for (float& out : result.own) {
        // Four sums: an addition need not wait for the one before it.
        double sums[4] = {0, 0, 0, 0};
        std::size_t k = 0;
        for (; k + 4 <= mean; k += 4) {
            for (std::size_t lane = 0; lane < 4; ++lane) sums[lane] += static_cast<double>(sample[k + lane]);
        }
        for (; k < mean; ++k) sums[0] += static_cast<double>(sample[k]);
        out = static_cast<float>((sums[0] + sums[1] + sums[2] + sums[3]) * share);
        sample += mean;
    }
    result.samples = result.own;
    return result;
}

}  // namespace tacto
