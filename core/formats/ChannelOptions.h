// ChannelOptions.h - columns, units and probe factors of ReadOptions on what a file holds: the same for every format.
#pragma once

#include "core/formats/CaptureFormat.h"

namespace tacto {

/// A unit as oscilloscopes spell it ("mV", "Volt", "µA", "second") in terms of V, A or s.
struct SpelledUnit {
    std::string_view unit;  ///< "V", "A", "s"; "" for a bare number
    double factor = 1;      ///< a number in the spelled unit times this is in `unit`
};
/// Capitals ignored: no oscilloscope writes megavolts. Nothing for an unknown one.
[[nodiscard]] std::optional<SpelledUnit> spelledUnit(std::string_view text);
/// The unit of what a channel measures; units of time are none.
[[nodiscard]] std::optional<SpelledUnit> channelUnit(std::string_view text);

/// One channel as it stands in the file, and then as it will be read.
struct ChannelPlan {
    std::string name;
    std::size_t number = 0;   ///< the number by which options name the column or channel, from 1
    std::string unit;         ///< "V", "A" or ""
    double factor = 1;        ///< the file's numbers times this are in `unit`
    std::string unknownUnit;  ///< what the file says and is not understood; empty once an option says better
    double low = 0;           ///< the input range by the options, in `unit`; equal = as the file says
    double high = 0;
};

/// Keeps and orders the channels by options.columns, replaces units and multiplies by probe factors.
/// Errors: InvalidArgument naming the option, its value and the channels there are: a channel that is not there, one
/// named twice, an unknown unit, a probe factor that is 0 or not finite, a range whose ends are not finite or not
/// rising. ParseError for a unit that stays unknown.
[[nodiscard]] Result<std::vector<ChannelPlan>> planChannels(std::vector<ChannelPlan> channels,
                                                            const ReadOptions& options, std::string_view file);

/// Applies them to channels that were read already, numbered from 1. `plans` say what their numbers were multiplied by;
/// they are as many as the channels and in their order. Range, resolution and tolerances follow. Errors: as
/// planChannels(); InvalidArgument for a time column or rows to skip, which only tables have.
[[nodiscard]] Result<void> applyChannelOptions(Capture& capture, std::vector<ChannelPlan> plans,
                                               const ReadOptions& options, std::string_view file);

/// The rate that --sample-rate asks for. Errors: InvalidArgument unless it is finite and above 0.
[[nodiscard]] Result<double> rateFrom(const ReadOptions& options);

/// The text in lower case, trimmed: how names are compared.
[[nodiscard]] std::string folded(std::string_view text);

}  // namespace tacto
