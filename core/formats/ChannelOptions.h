// ChannelOptions.h - applies columns, units and probe factors of ReadOptions, in the same way for every format.
#pragma once

#include "core/formats/CaptureFormat.h"

namespace tacto {

/// An oscilloscope's spelling of a unit ("mV", "Volt", "µA", "second"), converted to V, A or s.
struct SpelledUnit {
    std::string_view unit;  ///< "V", "A", "s"; "" for a bare number
    double factor = 1;      ///< number in `unit` = number in the spelled unit times this factor
};
/// Case is ignored, since no oscilloscope writes megavolts. Returns nothing for an unknown unit.
[[nodiscard]] std::optional<SpelledUnit> spelledUnit(std::string_view text);
/// Returns the unit of a measured quantity; for units of time, returns nothing.
[[nodiscard]] std::optional<SpelledUnit> channelUnit(std::string_view text);

/// One channel: first as the file describes it, later as it will be read.
struct ChannelPlan {
    std::string name;
    std::size_t number = 0;   ///< number of the column or channel in options, from 1
    std::string unit;         ///< "V", "A" or ""
    double factor = 1;        ///< factor from the file's numbers to `unit`
    std::string unknownUnit;  ///< unit in the file that is not understood; empty once an option replaces it
    double low = 0;           ///< lower end of the input range in `unit`; equal ends = as the file says
    double high = 0;
};

/// Selects and orders the channels by options.columns, replaces units and multiplies by probe factors. Errors:
/// InvalidArgument naming the option, its value and the existing channels: a missing channel, a channel named twice, an
/// unknown unit, a probe factor that is 0 or not finite, a range whose ends are not finite or not rising. ParseError
/// for a unit that is still unknown.
[[nodiscard]] Result<std::vector<ChannelPlan>> planChannels(std::vector<ChannelPlan> channels,
                                                            const ReadOptions& options, std::string_view file);

/// Applies the options to channels already read, numbered from 1. `plans` has one entry per channel, in the same order,
/// with the factor already applied. Range, resolution and tolerances are scaled too. Errors: as planChannels();
/// InvalidArgument for a time column or rows to skip, which only tables have.
[[nodiscard]] Result<void> applyChannelOptions(Capture& capture, std::vector<ChannelPlan> plans,
                                               const ReadOptions& options, std::string_view file);

/// Returns the rate given with --sample-rate. Errors: InvalidArgument unless it is finite and above 0.
[[nodiscard]] Result<double> rateFrom(const ReadOptions& options);

/// Returns the text trimmed and in lower case, for the comparison of names.
[[nodiscard]] std::string folded(std::string_view text);

}  // namespace tacto
