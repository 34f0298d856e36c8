#pragma once
// Serves one request after the other until the client is gone.

namespace voledit {

/// Runs on the socket `client`; returns when it closes. Failures are answers, never exceptions.
void serve(int client);

}  // namespace voledit
