// SessionListener.h - is told what a session writes, while it writes it.
//
// It hears what the session has taken and nothing else: samples, commands, events and trials in the order of their
// rows, samples before their chunk has a row. A command and an event have their place in the hash chain.
//
// Thread-safety: called from whichever thread writes, one call at a time. Returns at once: whoever records waits
// meanwhile. Never calls the writer.
#pragma once

#include "core/base/Stream.h"
#include "core/session/SessionTypes.h"

namespace tacto {

class SessionListener {
public:
    virtual ~SessionListener() = default;
    virtual void onStream(int id, const SessionStream& stream) noexcept = 0;
    virtual void onSamples(int stream, const SampleBlock& block) noexcept = 0;
    virtual void onCommand(const SessionRow& command) noexcept = 0;
    virtual void onEvent(const SessionRow& event) noexcept = 0;
    virtual void onTrial(const SessionTrial& trial) noexcept = 0;
};

}  // namespace tacto
