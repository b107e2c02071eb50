// Only there so that its target has precompiled headers, which the test programs share.
