#include "app/scripting/engine/DeclarationReader.h"

#include <QDeadlineTimer>
#include <QProcess>
#include <QRegularExpression>
#include <algorithm>
#include <mutex>

#include "app/scripting/engine/Arming.h"
#include "app/scripting/engine/HostFunction.h"
#include "app/scripting/engine/MemoryGuard.h"
#include "app/scripting/engine/ScriptThread.h"
#include "core/base/JsonText.h"
#include "core/base/ProgramPath.h"

namespace tacto {

namespace {

/// For what only declares something.
constexpr std::size_t kMaxMemory = std::size_t{512} << 20;
constexpr std::size_t kMaxAnswer = 4'000'000;  // bytes

/// Takes protocol() and refuses everything else: a declaration has no bench.
class DeclarationPort final : public HostPort {
public:
    Result<nlohmann::json> call(const HostFunction& function, const nlohmann::json& arguments, int) override {
        if (!function.object.empty() || function.name != "protocol") {
            return fail(ErrorCode::InvalidArgument, "{}{}{} can be used inside run(p) only", function.object,
                        function.object.empty() ? "" : ".", function.name);
        }
        if (arguments.size() < 3) return fail(ErrorCode::InvalidArgument, "protocol() was given nothing");
        // Here, so that the script's error names its line.
        if (const auto sound = parseDeclaration(arguments[0], arguments[1], arguments[2]); !sound)
            return failure(sound);
        const std::lock_guard lock(mutex_);
        if (declared_) return fail(ErrorCode::InvalidArgument, "protocol() was called twice");
        declared_ = nlohmann::json{arguments[0], arguments[1], arguments[2]};
        return nlohmann::json();
    }

    std::mutex mutex_;
    std::optional<nlohmann::json> declared_;  // guarded
    std::optional<ScriptError> error_;        // guarded
};

/// Whether a script's text names a host function that asks this question.
bool mayAsk(const QString& text, std::string_view question) {
    return std::ranges::any_of(hostFunctions(), [&](const HostFunction& function) {
        if (function.asks != question) return false;
        const auto of = [](std::string_view word) {
            return QRegularExpression::escape(QString::fromUtf8(word.data(), static_cast<qsizetype>(word.size())));
        };
        const QRegularExpression call(
            QStringLiteral(R"(\b%1\s*\.\s*%2\b)").arg(of(function.object), of(function.name)));
        return call.match(text).hasMatch();
    });
}

void findQuestions(const ProtocolSource& source, ProtocolDeclaration& declaration) {
    const QString text = QString::fromStdString(source.text);
    static const QRegularExpression asks(
        QStringLiteral(R"re(\boperator\s*\.\s*(?:confirm|choose|enter)\s*\(\s*(?:(["'])([^"'\\]*)\1\s*([,+]))?)re"));
    for (auto matches = asks.globalMatch(text); matches.hasNext();) {
        const auto match = matches.next();
        std::string name = match.captured(2).toStdString();
        if (!name.empty() && match.captured(3) == "+") name += '*';  // "dmm-" + load: its beginning is known
        if (name.empty()) {
            declaration.hasOtherQuestions = true;
        } else if (std::find(declaration.questions.begin(), declaration.questions.end(), name) ==
                   declaration.questions.end()) {
            declaration.questions.push_back(name);
        }
    }
    // In this order, as a form shows them.
    for (const std::string_view question : {"wiring", kConfirmArming, "surface-*", "fit-load"}) {
        if (mayAsk(text, question)) declaration.questions.emplace_back(question);
    }
}

Result<nlohmann::json> declareElsewhere(const ProtocolSource& source, std::chrono::milliseconds limit) {
    // Its start on a busy machine, and the time that a script may take to end when asked to.
    constexpr std::chrono::milliseconds kAround{10'000};
    const auto program = programBeside("tactoscope-declare");
    QProcess reader;
    reader.setProgram(QString::fromStdString(program.string()));
    reader.setArguments({QString::fromStdString(source.name), QString::fromStdString(source.path.string()),
                         QString::number(limit.count())});
    reader.setStandardErrorFile(QProcess::nullDevice());
    reader.start();
    if (!reader.waitForStarted()) {
        return fail(ErrorCode::NotFound, "{} cannot be read: {} does not start ({}); install Tactoscope again",
                    fileOf(source), program.string(), reader.errorString().toStdString());
    }
    reader.write(QByteArray::fromStdString(source.text));
    reader.closeWriteChannel();
    const QDeadlineTimer deadline(limit + kAround);
    std::string answer;
    bool more = true;
    while (more && answer.size() <= kMaxAnswer) {
        more = reader.waitForReadyRead(static_cast<int>(deadline.remainingTime()));
        answer += reader.readAllStandardOutput().toStdString();
    }
    if (answer.size() > kMaxAnswer) {
        reader.kill();
        reader.waitForFinished();
        return fail(ErrorCode::ParseError,
                    "{}:1: the lines outside run(p) declare more than the {} bytes that are accepted", fileOf(source),
                    kMaxAnswer);
    }
    if (reader.state() != QProcess::NotRunning && !reader.waitForFinished(static_cast<int>(deadline.remainingTime()))) {
        reader.kill();
        reader.waitForFinished();
        return fail(ErrorCode::Timeout, "{}:1: the lines outside run(p) did not end", fileOf(source));
    }
    // A sanitizer ends a program with a code where it would crash otherwise.
    if (reader.exitStatus() != QProcess::NormalExit || reader.exitCode() != 0) {
        return fail(ErrorCode::ParseError, "{}:1: the lines outside run(p) made the script engine crash",
                    fileOf(source));
    }
    answer += reader.readAllStandardOutput().toStdString();
    return readAnswer(answer, fileOf(source));
}

}  // namespace

nlohmann::json answerOf(const Result<nlohmann::json>& declared) {
    if (declared) return {{"declared", *declared}};
    return {{"code", static_cast<int>(declared.error().code)}, {"text", declared.error().message}};
}

Result<nlohmann::json> readAnswer(std::string_view answer, std::string_view from) {
    auto read = parseJson(answer, from, {.bytes = kMaxAnswer, .depth = 64});
    if (!read) return failure(read);
    if (!read->is_object()) *read = nlohmann::json::object();
    if (read->contains("declared") && (*read)["declared"].is_array() && (*read)["declared"].size() == 3)
        return (*read)["declared"];
    const auto code = read->value("code", nlohmann::json());
    const auto text = read->value("text", nlohmann::json());
    const bool known = code == static_cast<int>(ErrorCode::Timeout) || code == static_cast<int>(ErrorCode::ParseError);
    if (known && text.is_string()) return fail(static_cast<ErrorCode>(code.get<int>()), "{}", text.get<std::string>());
    return fail(ErrorCode::ParseError, "{}:1: the lines outside run(p) declare nothing that can be read", from);
}

Result<ProtocolDeclaration> readDeclaration(const ProtocolSource& source, std::chrono::milliseconds limit) {
    auto declared = source.shipped ? declareHere(source, limit) : declareElsewhere(source, limit);
    if (!declared) return failure(declared);
    auto declaration = parseDeclaration((*declared)[0], (*declared)[1], (*declared)[2]);
    if (!declaration) return fail(ErrorCode::ParseError, "{}:1: {}", fileOf(source), declaration.error().message);
    declaration->name = source.name;
    findQuestions(source, *declaration);
    return declaration;
}

Result<nlohmann::json> declareHere(const ProtocolSource& source, std::chrono::milliseconds limit) {
    const std::string file = fileOf(source);
    auto port = std::make_shared<DeclarationPort>();
    ScriptThread thread(port, source, [raw = port.get()](Sandbox& sandbox) {
        auto error = sandbox.load();
        const std::lock_guard lock(raw->mutex_);
        raw->error_ = std::move(error);
    });
    bool tooLarge = false;
    auto end = ScriptThread::End::Running;
    {
        const MemoryGuard memory(
            [&] {
                tooLarge = true;
                thread.interrupt();
            },
            kMaxMemory);
        end = thread.wait(limit);
    }
    if (tooLarge) {
        if (end == ScriptThread::End::Running) end = thread.wait();
        const bool abandoned = end == ScriptThread::End::Abandoned;
        return fail(ErrorCode::Timeout, "{}:1: the lines outside run(p) took more than {} MiB of memory{}", file,
                    kMaxMemory >> 20, abandoned ? ", and did not end when asked to" : "");
    }
    if (end == ScriptThread::End::Running) {
        thread.interrupt();
        const bool abandoned = thread.wait() == ScriptThread::End::Abandoned;
        return fail(ErrorCode::Timeout, "{}:1: the lines outside run(p) did not end within {} ms{}", file,
                    limit.count(), abandoned ? ", nor when asked to" : "");
    }
    const std::lock_guard lock(port->mutex_);
    if (port->error_) return fail(ErrorCode::ParseError, "{}", port->error_->text());
    if (!port->declared_) {
        return fail(ErrorCode::ParseError, "{}:1: the script does not call protocol({{ title: ... }})", file);
    }
    return *port->declared_;
}

}  // namespace tacto
