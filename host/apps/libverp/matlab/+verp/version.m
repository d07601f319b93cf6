function text = version()
%VERP.VERSION The revision of the library's sources.
  text = verp_mex('version');
end
