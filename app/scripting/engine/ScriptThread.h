// ScriptThread.h - a thread with a script's engine on it, which can be asked to end and, if it does not, given up.
//
// Thread-safety: interrupt() from any thread; wait() has one caller.
#pragma once

#include <chrono>
#include <functional>
#include <memory>
#include <optional>
#include <thread>

#include "app/scripting/engine/Sandbox.h"

namespace tacto {

class ScriptThread {
public:
    /// How long a script may go on after it was asked to end: it is given up, with time to say so, within a second.
    static constexpr std::chrono::milliseconds kGrace{800};
    enum class End {
        Done,       ///< the body returned; its thread has ended
        Abandoned,  ///< it did not end in kGrace: thread, engine and port live on until it does, if ever
        Running,    ///< `limit` passed
    };

    /// Makes a sandbox on a new thread and calls `body` with it. What the two hold must not refer to anything that
    /// ends before an abandoned thread would: they are kept alive with it.
    ScriptThread(std::shared_ptr<HostPort> port, ProtocolSource source, std::function<void(Sandbox&)> body);
    /// Interrupts and waits.
    ~ScriptThread();
    ScriptThread(const ScriptThread&) = delete;
    ScriptThread& operator=(const ScriptThread&) = delete;

    void interrupt() noexcept;
    [[nodiscard]] End wait(std::optional<std::chrono::milliseconds> limit = {});

    /// Abandoned threads of this process that still run.
    [[nodiscard]] static int abandonedRunning() noexcept;

private:
    struct Shared;
    std::shared_ptr<Shared> shared_;
    std::thread thread_;
};

}  // namespace tacto
