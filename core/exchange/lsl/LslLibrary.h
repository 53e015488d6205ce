// LslLibrary.h - the functions of liblsl that are used here, loaded at run time: no Debian package has the library.
//
// The prototypes are those of liblsl's C interface (github.com/sccn/liblsl, include/lsl), which is stable since 1.13.
// Once loaded the library stays: threads of its own may run until the program ends.
//
// Thread-safety: load() any thread; the functions as liblsl's, which may be called by several threads.
#pragma once

#include <cstdint>
#include <filesystem>
#include <memory>

#include "core/base/Result.h"

namespace tacto {

// What liblsl hands out is known by its address alone.
struct LslInfo;
struct LslXml;
struct LslOutlet;
struct LslInlet;

struct LslLibrary {
    static constexpr std::int32_t kDouble64 = 2, kString = 3;  ///< formats of channels

    std::filesystem::path file;  ///< as it was found

    std::int32_t (*version)();  ///< 100 times the major number and the minor number: 118
    double (*localClock)();     ///< seconds
    const char* (*lastError)();
    LslInfo* (*createInfo)(const char* name, const char* type, std::int32_t channels, double rate_hz,
                           std::int32_t format, const char* sourceId);
    void (*destroyInfo)(LslInfo*);
    std::int32_t (*channelCount)(LslInfo*);
    std::int32_t (*channelFormat)(LslInfo*);
    LslXml* (*description)(LslInfo*);
    LslXml* (*appendChild)(LslXml*, const char* name);
    LslXml* (*appendValue)(LslXml*, const char* name, const char* value);
    LslOutlet* (*createOutlet)(LslInfo*, std::int32_t chunk, std::int32_t buffered);
    void (*destroyOutlet)(LslOutlet*);
    std::int32_t (*hasConsumers)(LslOutlet*);
    std::int32_t (*pushNumbers)(LslOutlet*, const double* values, double stamp_s, std::int32_t pushThrough);
    std::int32_t (*pushText)(LslOutlet*, const char** text, const std::uint32_t* length, double stamp_s,
                             std::int32_t pushThrough);
    std::int32_t (*resolveByProperty)(LslInfo** found, std::uint32_t most, const char* property, const char* value,
                                      std::int32_t least, double timeout_s);
    LslInlet* (*createInlet)(LslInfo*, std::int32_t buffered, std::int32_t chunk, std::int32_t recover);
    void (*destroyInlet)(LslInlet*);
    void (*openStream)(LslInlet*, double timeout_s, std::int32_t* error);
    double (*timeCorrection)(LslInlet*, double timeout_s, std::int32_t* error);
    double (*pullText)(LslInlet*, char** text, std::uint32_t* length, std::int32_t count, double timeout_s,
                       std::int32_t* error);
    void (*destroyText)(char*);

    /// Loads the file that TACTOSCOPE_LSL names, and only that; without it the system's liblsl, else that of pylsl in
    /// the active Python environment (VIRTUAL_ENV or CONDA_PREFIX). Blocks for the disk and the library's own start.
    /// Errors: NotFound if there is none, saying what would be accepted; Unsupported for a file that is not liblsl 1.13
    /// or newer.
    [[nodiscard]] static Result<std::shared_ptr<const LslLibrary>> load();
};

}  // namespace tacto
