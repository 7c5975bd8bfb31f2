# What Doxygen reads of a header: its plain comments as documentation. The first line, the licence, becomes the start of
# the comment on the file; a comment behind a declaration belongs to it.
1s|.*|/// @file|
/^ *\/\//s|<|\&lt;|g
s|^( *)//( \|$)|\1///\2|
s|([;,{}]) +// |\1 ///< |
