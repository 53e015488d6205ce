// ForcedTrigger.h - an ability of some oscilloscopes: to take a record without a trigger.
//
// It is not a part of Oscilloscope: an instrument or a driver without the ability does not implement it.
//
// Thread-safety: as the oscilloscope's, its session thread.
#pragma once

#include "core/base/Result.h"

namespace tacto {

class ForcedTrigger {
public:
    virtual ~ForcedTrigger() = default;
    /// Takes one record as if a trigger came now, or as soon as the record's part before the trigger has passed since
    /// arm() or the last record. A true trigger that comes before then makes a triggered record instead. poll() gives
    /// it like any other, with `untriggered` set. After it the oscilloscope waits for triggers again.
    /// Errors: Unsupported while not armed; Device, Timeout.
    [[nodiscard]] virtual Result<void> forceTrigger() = 0;
};

}  // namespace tacto
