// CsvLayout.h - how the table of one oscilloscope is laid out: the dialects, recognised by their headers.
//
//   Rigol       `X,CH1,…,Start,Increment` + `Sequence,Volt,…,start,increment`: X is a sample index (DS1000Z, 2000,
//   4000)
//               `X,CH1,` + `Second,Volt,`: X is seconds (DS1000E)
//   Siglent     a block of keys (`Sample Interval,Analog:…`, `Source,CH1,…`), then `Second,Volt,…`
//   Tektronix   a block of keys (`Sample Interval,2e-08`, `Vertical Units,V,V`), then `TIME,CH1,…` (DPO, MSO, MDO)
//               keys in columns 1 and 2 of the first rows, time and volts in columns 4 and 5 of all (TDS)
//   Keysight    `x-axis,1,2` + `second,Volt,Volt` (InfiniiVision)
//   PicoScope   `Time,Channel A,…` + `(ms),(mV),…`
//   Plain       one line of names, units in them or in a line below: `time_s,voltage_v`, `t [ms], CH1 (mV)`
// Sources: files of the instruments themselves (Rigol, Tektronix MDO), descriptions of others by people who read them.
//
// Thread-safety: pure functions.
#pragma once

#include "core/formats/ChannelOptions.h"
#include "core/formats/CsvHead.h"

namespace tacto {

enum class CsvDialect { Rigol, Siglent, Tektronix, Keysight, PicoScope, Plain };

/// Where the times of the rows come from.
enum class RowTimes {
    Column,  ///< a column of times
    Index,   ///< a column of sample numbers: time = start + number * interval
    Counted  ///< none: row after row at the interval
};

struct CsvLayout {
    std::size_t width = 0;           ///< fields of a row; more may follow if they are empty
    std::vector<std::string> names;  ///< of the columns, as the file has them
    std::size_t dataOffset = 0;      ///< of the first row in the text
    std::size_t dataLine = 0;        ///< its number
    std::size_t headerLine = 0;      ///< of the line that names the columns, for messages
    RowTimes times = RowTimes::Column;
    std::size_t timeColumn = 0;
    double timeFactor = 1;               ///< of the time column to seconds
    std::optional<double> interval_s;    ///< as the header states it
    double start_s = 0;                  ///< of sample 0 where times are an index or counted
    std::optional<double> rows;          ///< how many the header announces
    std::optional<double> givenRate_hz;  ///< by the options: stamps are then not asked
    std::vector<ChannelPlan> channels;   ///< as they will be read; number is the column from 1
    std::vector<std::string> warnings;
};

/// Whether a table that begins so is of the dialect. Plain is any table.
[[nodiscard]] bool isOfDialect(CsvDialect dialect, const CsvHead& head);

/// Errors: ParseError naming line and what was expected; InvalidArgument for options that do not fit the table.
[[nodiscard]] Result<CsvLayout> layOut(CsvDialect dialect, const CsvHead& head, const ReadOptions& options,
                                       std::string_view file);

}  // namespace tacto
