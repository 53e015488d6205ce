// tactoscope-script: runs protocol scripts for the program that started it, and does nothing else. It has no device,
// file or session: calls from a script go to the program through one socket (ScriptMessage.h). A script that crashes
// the engine ends only this process (hazard H10).
#include <QCoreApplication>
#include <csignal>
#include <cstdio>
#include <cstdlib>
#include <sys/resource.h>
#include <sys/socket.h>
#include <sys/syscall.h>
#include <unistd.h>

#include "app/scripting/child/Confinement.h"
#include "app/scripting/child/Sandbox.h"
#include "app/scripting/wire/MemoryGuard.h"
#include "app/scripting/wire/ScriptMessage.h"

namespace tacto {
namespace {

using nlohmann::json;

/// Without the program, this process has nothing to do.
[[noreturn]] void end(int code) noexcept { std::_Exit(code); }

class Program final : public HostCalls {
public:
    HostAnswer call(int function, const json& arguments, int line) override {
        return ask({{"call", function}, {"with", arguments}, {"line", line}}, function);
    }
    HostAnswer refuse(int function, const std::string& why) override {
        return ask({{"refused", function}, {"why", shortened(why, kMaxReason)}}, function);
    }

private:
    HostAnswer ask(const json& message, int function) {
        if (auto sent = sendMessage(kScriptSocket, message); !sent) {
            if (sent.error().code == ErrorCode::InvalidArgument) return refuse(function, sent.error().message);
            end(0);
        }
        auto answer = receiveMessage(kScriptSocket);
        if (!answer) end(0);
        HostAnswer out;
        if (answer->contains("value")) {
            out.value = std::move((*answer)["value"]);
            return out;
        }
        out.failure = answer->at("failure").get<std::int64_t>();
        out.code = answer->at("code").get<int>();
        out.text = answer->at("text").get<std::string>();
        return out;
    }
};

void sayEnded(const std::optional<Thrown>& thrown) {
    json ended;
    if (thrown) {
        ended = {
            {"reason", shortened(thrown->reason, kMaxReason)}, {"line", thrown->line}, {"memory", thrown->outOfMemory}};
        if (thrown->failure) ended["failure"] = *thrown->failure;
    }
    if (!sendMessage(kScriptSocket, {{"ended", std::move(ended)}})) end(0);
}

std::vector<SeenFunction> functionsIn(const json& table) {
    std::vector<SeenFunction> functions;
    for (const auto& entry : table) {
        functions.push_back({entry.at("object").get<std::string>(), entry.at("name").get<std::string>(),
                             entry.at("property").get<bool>(), entry.at("javascript").get<std::string>()});
    }
    return functions;
}

/// Tells the kernel to end this process first if memory runs short.
void offerItself() noexcept {
    if (std::FILE* file = std::fopen("/proc/self/oom_score_adj", "we"); file != nullptr) {
        static_cast<void>(std::fputs("1000", file));
        static_cast<void>(std::fclose(file));
    }
}

int serve() {
    auto begun = receiveMessage(kScriptSocket);
    if (!begun || !begun->contains("start")) return 2;
    const auto& start = (*begun)["start"];
    const auto functions = functionsIn(start.at("functions"));
    const MemoryGuard memory([] { end(kTooMuchMemory); }, start.at("memory").get<std::size_t>(),
                             [parent = start.at("parent").get<pid_t>()] {
                                 if (::getppid() != parent) end(0);
                             });
    Program program;
    std::unique_ptr<Sandbox> sandbox;
    bool confined = false;
    if (!sendMessage(kScriptSocket, {{"ready", true}})) return 0;
    for (;;) {
        auto message = receiveMessage(kScriptSocket);
        if (!message) return 0;
        if (message->contains("load")) {
            const auto& script = (*message)["load"];
            sandbox.reset();
            sandbox = std::make_unique<Sandbox>(program, functions, script.at("file").get<std::string>(),
                                                script.at("text").get<std::string>());
            if (!std::exchange(confined, true)) confine();
            sayEnded(sandbox->load());
        } else if (message->contains("run") && sandbox) {
            sayEnded(sandbox->run((*message)["run"]));
        } else {
            return 2;
        }
    }
}

}  // namespace
}  // namespace tacto

int main(int argc, char** argv) {
    ::syscall(SYS_close_range, tacto::kScriptSocket + 1, ~0U, 0);  // closes everything else that the program left open
    int type = 0;
    socklen_t size = sizeof type;
    if (argc != 1 || ::getsockopt(tacto::kScriptSocket, SOL_SOCKET, SO_TYPE, &type, &size) != 0) {
        std::fputs("tactoscope-script is started by Tactoscope, to run protocol scripts\n", stderr);
        return 2;
    }
    const rlimit none{0, 0};
    setrlimit(RLIMIT_CORE, &none);
    std::signal(SIGPIPE, SIG_IGN);
    std::signal(SIGINT, SIG_IGN);  // the program handles Ctrl+C and then ends this process
    std::signal(SIGHUP, SIG_IGN);
    tacto::offerItself();
    const QCoreApplication application(argc, argv);
    // Ends without destroying the engine: a script may have left it in any state.
    tacto::end(tacto::serve());
}
