// ScriptMessage.h - the messages between the program and tactoscope-script over a pair of sockets. A frame is a length
// (four bytes, lowest first) and a binary value.
//
// The program sends {start}, {load}, {run} and, for each call, {value} or {failure, code, text}. The script's process
// sends {ready} once, {call, with, line} or {refused, why}, and after each load and run {ended} with the exception or
// null. The script's process may send anything (hazard H10): the size of a frame is checked before it is read, and that
// of a value before it is built.
//
// Thread-safety: a socket has one reader and one writer at a time.
#pragma once

#include <functional>
#include <nlohmann/json.hpp>
#include <string>
#include <string_view>

#include "core/base/Result.h"

namespace tacto {

/// The file descriptor of the socket in tactoscope-script.
inline constexpr int kScriptSocket = 3;
/// The exit code of tactoscope-script when it has used up its memory limit.
inline constexpr int kTooMuchMemory = 77;
inline constexpr std::size_t kMaxFrame = std::size_t{64} << 20;  ///< bytes
inline constexpr std::size_t kMaxValues = 10'000'000;            ///< values in a frame
inline constexpr int kMaxScriptDepth = 32;                       ///< depth of a value from a script
inline constexpr std::size_t kMaxReason = 2000;                  ///< longest text of an exception, in bytes

/// Called every 100 ms while waiting for the other end; an error that it returns ends the waiting.
using WhileWaiting = std::function<Result<void>()>;

/// Errors: Io if the other end is gone; InvalidArgument for a value longer than kMaxFrame; those of `waiting`.
[[nodiscard]] Result<void> sendMessage(int socket, const nlohmann::json& message, const WhileWaiting& waiting = {});

/// Waits for a whole message.
/// Errors: Io if the other end is gone; ParseError if the frame is too long or holds no value; those of `waiting`.
[[nodiscard]] Result<nlohmann::json> receiveMessage(int socket, const WhileWaiting& waiting = {});

/// Returns at most `most` bytes of `text`, in whole characters; an ellipsis marks omitted text.
[[nodiscard]] std::string shortened(std::string_view text, std::size_t most);

}  // namespace tacto
